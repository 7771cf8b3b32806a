/// @file goal_server.h
/// What the driver's actions share. Each of their goals begins something and follows it to its end.
#ifndef AIBO_DRIVER_NODE_GOAL_SERVER_H
#define AIBO_DRIVER_NODE_GOAL_SERVER_H

#include <actionlib/server/action_server.h>
#include <ros/console.h>
#include <ros/node_handle.h>
#include <ros/serialization.h>
#include <ros/steady_timer.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "aibo_client/exceptions.h"
#include "movement/mover.h"
#include "node/actions.h"
#include "node/orders.h"
#include "text/sentence.h"

namespace aibo_driver::node {

template <typename Spec>
using GoalOf = typename Spec::_action_goal_type::_goal_type;
template <typename Spec>
using ResultOf = typename Spec::_action_result_type::_result_type;
template <typename Spec>
using FeedbackOf = typename Spec::_action_feedback_type::_feedback_type;

/// An action server that keeps few goals, even if other nodes send many. actionlib keeps each goal for 5 s after its
/// end, begins these 5 s again whenever somebody cancels all goals, and never forgets a cancel that has no time and
/// names a goal that never came. At each change, it publishes all that it keeps. A single cancel with a time in the
/// future would end all later goals. This class drops the content of a goal after its end.
template <typename Spec>
class BoundedActionServer : public actionlib::ActionServer<Spec> {
 public:
  using GoalHandle = typename actionlib::ActionServer<Spec>::GoalHandle;

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
      : actionlib::ActionServer<Spec>(handle, name, accept, cancel, false), actions_(handle, name) {}

  // actionlib does not report a goal that was cancelled before it came, or a cancel of an unknown goal. So the server
  // listens to the same topics, and is called right after actionlib, which subscribed first. A shorter queue than
  // actionlib's own would drop messages, and this server could see the last message before actionlib does.
  void start() {
    constexpr std::uint32_t kQueueOfActionlib = 50;  // actionlib_server_sub_queue_size in action_server_imp.h
    actionlib::ActionServer<Spec>::start();
    watches_ = {
        actions_.subscribe<typename Spec::_action_goal_type>("goal", kQueueOfActionlib, [this](auto) { forget(); }),
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

/// How a goal ends.
template <typename Spec>
struct GoalEnd {
  enum class State { kSucceeded, kCanceled, kAborted };

  State state = State::kAborted;
  ResultOf<Spec> result;
  std::string text;
};

/// What the robot does for a goal.
template <typename Spec>
struct Activity {
  using Publish = std::function<void(const FeedbackOf<Spec>&)>;

  std::string text;                                  ///< a text that says that the robot has begun
  std::function<void(const movement::Order&)> stop;  ///< called when the goal is cancelled; may throw
  /// Called again and again. It may publish feedback. It returns the goal's end as soon as there is one.
  std::function<std::optional<GoalEnd<Spec>>(const Publish&)> look;
};

/// What distinguishes an action from others.
template <typename Spec>
struct ActionKind {
  std::string name;
  std::chrono::milliseconds period{100};  ///< the time between two looks at a goal
  /// Begins what a goal asks for. If this throws, the goal is rejected.
  std::function<Activity<Spec>(const GoalOf<Spec>&, const movement::Order&)> begin;
  /// Makes the end of a goal that is rejected.
  std::function<GoalEnd<Spec>(const std::exception&)> refuse;
};

/// Serves an action. Up to kMostGoals goals of up to kMostBytesOfGoal may go on at a time; others are rejected. A
/// cancelled goal tells the robot to stop, and goes on until the robot has stopped. Then it ends as canceled, unless it
/// has succeeded.
template <typename Spec>
class GoalServer {
 public:
  static constexpr std::size_t kMostGoals = 32;
  /// Enough for a trajectory of all joints with thirty points a second, for a hundred seconds.
  static constexpr std::size_t kMostBytesOfGoal = 1 << 20;

  GoalServer(ros::NodeHandle handle, ActionKind<Spec> kind) : kind_(std::move(kind)) {
    timer_ = makeTimer(handle, kind_.period, [this] { look(); });
    server_ = std::make_unique<Server>(
        handle, kind_.name, [this](const GoalHandle& goal) { accept(goal); },
        [this](const GoalHandle& goal) { cancel(goal); });
    server_->start();
  }

 private:
  using Server = BoundedActionServer<Spec>;
  using GoalHandle = typename Server::GoalHandle;

  struct ActiveGoal {
    GoalHandle goal;
    Activity<Spec> activity;
  };

  void accept(GoalHandle goal) {
    try {
      checkSize(*goal.getGoal());
      Activity<Spec> activity = kind_.begin(*goal.getGoal(), orderOfGoal(goal.getGoalID().id));
      goal.setAccepted(activity.text);
      goals_.push_back({goal, std::move(activity)});
      timer_.start();
    } catch (const std::exception& error) {
      const GoalEnd<Spec> end = kind_.refuse(error);
      goal.setRejected(end.result, end.text);
    }
  }

  void checkSize(const GoalOf<Spec>& goal) const {
    if (goals_.size() >= kMostGoals) {
      throw aibo_client::CommandException(std::to_string(kMostGoals) +
                                          " goals are already active, and no more are accepted. Cancel some of them.");
    }
    const std::size_t size = ros::serialization::serializationLength(goal);
    if (size > kMostBytesOfGoal) {
      throw aibo_client::InvalidArgumentException("it has " + std::to_string(size) + " bytes, and at most " +
                                                  std::to_string(kMostBytesOfGoal) + " bytes are allowed");
    }
  }

  void cancel(const GoalHandle& goal) {
    const auto is_it = [&goal](const ActiveGoal& each) { return each.goal == goal; };
    const auto found = std::find_if(goals_.begin(), goals_.end(), is_it);
    if (found == goals_.end()) {
      return;
    }
    try {
      found->activity.stop(orderOfGoal(goal.getGoalID().id));
    } catch (const std::exception& error) {
      ROS_WARN_STREAM_NAMED("joints", "A goal of " << kind_.name << " was cancelled, but what it began was not "
                                                   << "stopped: " << error.what());
    }
    look();
  }

  void look() {
    const auto is_over = [](ActiveGoal& each) { return isOver(&each.goal, each.activity); };
    goals_.erase(std::remove_if(goals_.begin(), goals_.end(), is_over), goals_.end());
    if (goals_.empty()) {
      timer_.stop();
    }
  }

  static bool isOver(GoalHandle* goal, const Activity<Spec>& activity) {
    const auto end = activity.look([goal](const FeedbackOf<Spec>& feedback) { goal->publishFeedback(feedback); });
    if (end) {
      finish(goal, *end);
    }
    return end.has_value();
  }

  static void finish(GoalHandle* goal, const GoalEnd<Spec>& end) {
    const bool was_cancelled = goal->getGoalStatus().status == actionlib_msgs::GoalStatus::PREEMPTING;
    if (end.state == GoalEnd<Spec>::State::kSucceeded) {
      goal->setSucceeded(end.result, end.text);
    } else if (end.state == GoalEnd<Spec>::State::kCanceled || was_cancelled) {
      goal->setCanceled(end.result, end.text);
    } else {
      goal->setAborted(end.result, end.text);
    }
  }

  const ActionKind<Spec> kind_;
  std::unique_ptr<Server> server_;
  std::vector<ActiveGoal> goals_;
  ros::SteadyTimer timer_;
};

/// @throw CommandException the movement was refused
inline void throwIfRefused(const movement::Mover::Answer& begun) {
  const movement::EndedMovement* const ended = begun.ended();
  if (ended != nullptr && ended->how == aibo_client::EndedHow::kRefused) {
    throw aibo_client::CommandException(text::sentence(ended->reason));
  }
}

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_GOAL_SERVER_H
