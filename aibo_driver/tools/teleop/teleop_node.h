/// @file teleop_node.h
/// What the nodes that steer by keys and by a joystick have in common.
#ifndef AIBO_DRIVER_TOOLS_TELEOP_TELEOP_NODE_H
#define AIBO_DRIVER_TOOLS_TELEOP_TELEOP_NODE_H

#include <aibo_driver/RobotState.h>
#include <geometry_msgs/Twist.h>
#include <ros/node_handle.h>

#include <functional>
#include <string>

#include "node/stop_client.h"
#include "tools/teleop/key_steering.h"
#include "tools/teleop/service_caller.h"

namespace teleop {

/// The parameters ~speed and ~side_speed, 0..1 m/s, and ~turn_speed, 0..10 rad/s. Those that are not set are as usual.
/// @throw std::runtime_error one is no number, or out of its range; the message names it
Speeds readSpeeds(const ros::NodeHandle& parameters);

geometry_msgs::Twist toTwist(const aibo_client::WalkVelocity& velocity);

/// Stops the robot, and lets it move again. Only one thread may call it and serve the handle's callbacks.
class StopAndRelease {
 public:
  /// @param handle a handle in the driver's namespace
  /// @param how a sentence that tells the user how to release the robot
  /// @param tell shows the user who has stopped the robot, and that it may move again
  StopAndRelease(ros::NodeHandle handle, std::string how, std::function<void(const std::string&)> tell);

  /// Stops the robot (StopClient).
  void stop();

  /// Lets the robot move again, if somebody has stopped it.
  /// @return false if nobody has
  bool release();

 private:
  void receive(const aibo_driver::RobotState::ConstPtr& state);

  const std::string how_;
  const std::function<void(const std::string&)> tell_;
  std::string stopped_by_;  ///< empty while the robot may move
  aibo_driver::node::StopClient stop_;
  ServiceCaller release_;
  ros::Subscriber states_;
};

}  // namespace teleop

#endif  // AIBO_DRIVER_TOOLS_TELEOP_TELEOP_NODE_H
