/// @file bounded_action_server.h
#ifndef AIBO_DRIVER_NODE_BOUNDED_ACTION_SERVER_H
#define AIBO_DRIVER_NODE_BOUNDED_ACTION_SERVER_H

#include <actionlib/server/action_server.h>
#include <ros/node_handle.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace aibo_driver::node {

/// An action server that keeps few goals, even if other nodes send many. actionlib keeps each goal for 5 s after its
/// end, begins these 5 s again whenever somebody cancels all goals, and never forgets a cancel that has no time and
/// names a goal that never came. At each change, it publishes all that it keeps. A single cancel with a time in the
/// future would end all later goals. This class drops the content of a goal after its end.
template <typename Action>
class BoundedActionServer : public actionlib::ActionServer<Action> {
 public:
  using GoalHandle = typename actionlib::ActionServer<Action>::GoalHandle;

  /// How many goals that have ended are kept, together with cancels of goals that have not come yet.
  static constexpr std::size_t kMostEnded = 32;
  /// A goal with a longer id (in bytes) is dropped at its end. actionlib makes the id from a node's name, a number and
  /// a time.
  static constexpr std::size_t kLongestId = 1000;

  /// Constructs the server; start() starts it.
  /// @param handle the callbacks of its queue run one after the other
  /// @param name the name of the action
  /// @param accept, cancel see actionlib::ActionServer
  template <typename Accept, typename Cancel>
  BoundedActionServer(const ros::NodeHandle& handle, const std::string& name, const Accept& accept,
                      const Cancel& cancel)
      : actionlib::ActionServer<Action>(handle, name, accept, cancel, false), actions_(handle, name) {}

  // actionlib does not report a goal that was cancelled before it came, or a cancel of an unknown goal. So the server
  // listens to the same topics, and is called right after actionlib, which subscribed first. A shorter queue than
  // actionlib's own would drop messages, and this server could see the last message before actionlib does.
  void start() {
    constexpr std::uint32_t kQueueOfActionlib = 50;  // actionlib_server_sub_queue_size in action_server_imp.h
    actionlib::ActionServer<Action>::start();
    watches_ = {
        actions_.subscribe<typename Action::_action_goal_type>("goal", kQueueOfActionlib, [this](auto) { forget(); }),
        actions_.subscribe<actionlib_msgs::GoalID>("cancel", kQueueOfActionlib, [this](auto) { forget(); })};
  }

 private:
  void forget() {
    const boost::recursive_mutex::scoped_lock lock(this->lock_);
    this->last_cancel_ = std::min(this->last_cancel_, ros::Time::now());
    const auto has_ended = [](const auto& goal) { return goal.handle_tracker_.expired(); };
    auto& goals = this->status_list_;
    for (auto& goal : goals) {
      if (has_ended(goal)) {
        goal.goal_.reset();
      }
    }
    goals.remove_if([&](const auto& goal) { return has_ended(goal) && goal.status_.goal_id.id.size() > kLongestId; });
    auto ended = static_cast<std::size_t>(std::count_if(goals.begin(), goals.end(), has_ended));
    goals.remove_if([&](const auto& goal) { return has_ended(goal) && ended > kMostEnded && ended-- > 0; });
  }

  ros::NodeHandle actions_;
  std::array<ros::Subscriber, 2> watches_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_BOUNDED_ACTION_SERVER_H
