/// @file walk_settings.h
#ifndef AIBO_DRIVER_WALK_WALK_SETTINGS_H
#define AIBO_DRIVER_WALK_WALK_SETTINGS_H

#include <chrono>

#include "aibo_client/walk.h"

namespace aibo_driver::walk {

/// The parameters of walking. docs/ros_interface.md describes them for users.
///
/// A robot may report that it walks straight ahead with 0.1 m/s. Really it walks a bit slower or faster, to one side,
/// or in a curve, because its feet slip. The scales, the direction and the curve were measured (docs/walking.md). They
/// correct both what is sent to the robot and what it reports, so cmd_vel and odom are the real velocities.
struct WalkSettings {
  double speed_limit = 1.0;  ///< m/s, 0..1, forward and backward; the robot has a limit of its own
  double side_limit = 1.0;   ///< m/s, 0..1, to either side; the robot has a limit of its own
  double turn_limit = 10.0;  ///< rad/s, 0..10; the robot has a limit of its own

  double scale = 1.0;       ///< the real way ahead or back as a multiple of what the robot reports, 0.2..5
  double side_scale = 1.0;  ///< the same to the sides, 0.2..5
  double turn_scale = 1.0;  ///< the real turn as a multiple of what the robot reports, 0.2..5
  double direction = 0.0;   ///< rad, -1..1, the real direction of straight ahead; positive to the left
  double curve = 0.0;       ///< rad/m, -5..5, how far it turns on each metre ahead; positive to the left

  std::chrono::milliseconds timeout{500};  ///< 100..500 ms; the robot stops this long after the last cmd_vel
  bool publish_odom_tf = true;             ///< publish tf from odom to base_footprint
};

/// The real velocity of a robot that reports the velocity `said`.
aibo_client::WalkVelocity realVelocity(const aibo_client::WalkVelocity& said, const WalkSettings& settings);

/// The velocity to send to a robot that should walk with the velocity `wanted`. If that is too fast, the same factor
/// slows down all parts of it, so that the robot walks the same way. A part whose limit is 0 becomes 0.
/// @param robot the robot's own limits. If all of them are 0, the robot does not report them and limits velocities
///   itself
aibo_client::WalkVelocity velocityToSend(const aibo_client::WalkVelocity& wanted, const WalkSettings& settings,
                                         const aibo_client::WalkLimits& robot);

}  // namespace aibo_driver::walk

#endif  // AIBO_DRIVER_WALK_WALK_SETTINGS_H
