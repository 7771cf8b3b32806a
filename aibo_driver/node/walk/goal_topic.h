/// @file goal_topic.h
#ifndef AIBO_DRIVER_NODE_WALK_GOAL_TOPIC_H
#define AIBO_DRIVER_NODE_WALK_GOAL_TOPIC_H

#include <geometry_msgs/PoseStamped.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>

#include <optional>

#include "node/walk/goal_walks.h"

namespace aibo_driver::node {

/// The topic goal. The robot walks to the newest goal.
///
/// Only one thread at a time may use an object of this class.
class GoalTopic {
 public:
  /// @param walks must outlive the object
  explicit GoalTopic(GoalWalks& walks) : walks_(walks) {}

  GoalTopic(const GoalTopic&) = delete;
  GoalTopic& operator=(const GoalTopic&) = delete;

  /// @param handle the handle of the walk commander, whose thread steers all walks
  void subscribe(const ros::NodeHandle& handle);

 private:
  void receive(const geometry_msgs::PoseStamped& goal, const movement::Order& order);
  void advance();

  GoalWalks& walks_;
  std::optional<GoalWalks::Walk> walk_;
  ros::SteadyTimer timer_;
  ros::Subscriber subscriber_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_WALK_GOAL_TOPIC_H
