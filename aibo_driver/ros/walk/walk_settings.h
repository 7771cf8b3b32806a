/// @file walk_settings.h
#ifndef AIBO_DRIVER_ROS_WALK_WALK_SETTINGS_H
#define AIBO_DRIVER_ROS_WALK_WALK_SETTINGS_H

#include <chrono>

#include "aibo_driver/walk.h"

namespace aibo_driver::node {

/// The parameters of walking. docs/ros_interface.md describes them for users.
///
/// A robot that says that it walks straight ahead with 0.1 m/s really goes a bit slower or faster, and to one side,
/// because its feet slip. Scale and direction were measured (docs/walking.md) and correct both what is sent to the
/// robot and what it says: cmd_vel and odom are about what it really does.
struct WalkSettings {
  double speed_limit = 1.0;  ///< m/s, 0..1, forward and backward; the robot has a limit of its own
  double side_limit = 1.0;   ///< m/s, 0..1, to either side; the same
  double turn_limit = 10.0;  ///< rad/s, 0..10; the same

  double scale = 1.0;       ///< way really walked, as a multiple of what the robot says, 0.2..5
  double turn_scale = 1.0;  ///< the same for turns
  double direction = 0.0;   ///< rad, -1..1, in which it really goes when it says straight ahead; positive to the left

  std::chrono::milliseconds timeout{500};  ///< 100..500 ms; that long after the last cmd_vel the robot stops
  bool publish_odom_tf = true;             ///< tf from odom to base_footprint
};

/// What a robot really does that says that it walks with this velocity.
WalkVelocity realVelocity(const WalkVelocity& said, const WalkSettings& settings);

/// What has to be sent to a robot that is to walk with this velocity. If it is too fast, all of it is slowed down by
/// the same factor, so that the robot takes the same way. A direction in which the limit is 0 is left out.
/// @param robot its own limits; all 0: it does not say them, and limits what it gets by itself
WalkVelocity velocityToSend(const WalkVelocity& wanted, const WalkSettings& settings, const WalkLimits& robot);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_WALK_WALK_SETTINGS_H
