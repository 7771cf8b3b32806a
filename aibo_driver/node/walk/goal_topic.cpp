#include "node/walk/goal_topic.h"

#include <ros/message_event.h>

#include <cstdint>

#include "node/orders.h"

namespace aibo_driver::node {

using geometry_msgs::PoseStamped;

void GoalTopic::subscribe(const ros::NodeHandle& handle) {
  ros::NodeHandle topics(handle);
  constexpr bool kOneShot = false;
  constexpr bool kAutostart = false;
  timer_ = topics.createSteadyTimer(
      ros::WallDuration(std::chrono::duration<double>(GoalWalks::kPeriod).count()),
      [this](const ros::SteadyTimerEvent&) { advance(); }, kOneShot, kAutostart);
  const boost::function<void(const ros::MessageEvent<PoseStamped const>&)> receive =
      [this](const ros::MessageEvent<PoseStamped const>& event) { this->receive(*event.getMessage(), orderOf(event)); };
  constexpr std::uint32_t kNewest = 1;
  subscriber_ = topics.subscribe<PoseStamped>("goal", kNewest, receive);
}

// If the goal is refused, the walk to the goal before it goes on.
void GoalTopic::receive(const PoseStamped& goal, const movement::Order& order) {
  GoalWalks::Walk walk = walks_.begin(goal, order);
  if (walk.begun().ended() == nullptr) {
    walk_ = std::move(walk);
    timer_.start();
  }
}

void GoalTopic::advance() {
  if (!walk_ || walk_->advance() != nullptr) {
    walk_.reset();
    timer_.stop();
  }
}

}  // namespace aibo_driver::node
