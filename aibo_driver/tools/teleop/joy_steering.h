/// @file joy_steering.h
#ifndef AIBO_DRIVER_TOOLS_TELEOP_JOY_STEERING_H
#define AIBO_DRIVER_TOOLS_TELEOP_JOY_STEERING_H

#include <optional>
#include <string>
#include <vector>

#include "aibo_driver/walk.h"
#include "tools/teleop/key_steering.h"

namespace teleop {

/// Which parts of a joystick or gamepad do what, by their places in sensor_msgs/Joy, from 0 on. config/joy.yaml sets
/// them.
struct JoyMapping {
  int dead_man_button = 4;         ///< the robot walks only while it is pressed
  int forward_axis = 1;            ///< positive is forward
  int left_axis = 0;               ///< positive is to the left
  int turn_axis = 3;               ///< positive is to the left
  Speeds speeds{0.15, 0.06, 1.0};  ///< at full deflection
  double dead_zone = 0.1;          ///< 0..0.9; a smaller deflection counts as none
};

/// Turns the state of a joystick into a velocity.
class JoySteering {
 public:
  explicit JoySteering(const JoyMapping& mapping) : mapping_(mapping) {}

  /// @param axes -1..1
  /// @param buttons 0 or 1
  /// @return what the robot is to do; none if it is not steered: the button is not pressed, and it was told so before
  std::optional<aibo_driver::WalkVelocity> steer(const std::vector<float>& axes, const std::vector<int>& buttons);

  /// What is wrong with a joystick of so many axes and buttons; empty if nothing. Such a joystick never steers.
  std::string problem(std::size_t axes, std::size_t buttons) const;

 private:
  double deflection(double axis) const;

  const JoyMapping mapping_;
  bool steers_ = false;
};

}  // namespace teleop

#endif  // AIBO_DRIVER_TOOLS_TELEOP_JOY_STEERING_H
