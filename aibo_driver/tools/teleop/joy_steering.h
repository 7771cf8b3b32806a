/// @file joy_steering.h
#ifndef AIBO_DRIVER_TOOLS_TELEOP_JOY_STEERING_H
#define AIBO_DRIVER_TOOLS_TELEOP_JOY_STEERING_H

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "aibo_driver/walk.h"
#include "tools/teleop/head_steering.h"
#include "tools/teleop/key_steering.h"

namespace teleop {

/// The place of an axis or button that does not exist.
constexpr int kNoPlace = -1;

/// Which parts of a joystick or gamepad do what, by their places in sensor_msgs/Joy, from 0 on, or kNoPlace.
/// config/joy.yaml sets them.
struct JoyMapping {
  int dead_man_button = 4;              ///< nothing moves unless it is pressed; not kNoPlace
  int forward_axis = 1;                 ///< positive is forward
  int turn_axis = 0;                    ///< positive is to the left
  int left_axis = 6;                    ///< walks sideways; positive is to the left
  int pan_axis = 3;                     ///< turns the head; positive is to the left
  int tilt_axis = 4;                    ///< positive is up
  int stop_button = 1;                  ///< works without the dead-man button
  int release_button = kNoPlace;        ///< lets the robot move again after a stop; with the dead-man button
  int picture_button = 0;               ///< works without the dead-man button
  std::map<std::string, int> motions;   ///< buttons, by the name of the motion
  std::map<std::string, int> postures;  ///< buttons, by the name of the service: stand, sit, rest
  Speeds speeds{0.15, 0.06, 1.0};       ///< at full deflection
  double head_speed = 1.0;              ///< rad/s, at full deflection
  double dead_zone = 0.1;               ///< 0..0.9; a smaller deflection counts as none
};

/// What the robot is to do. Each button counts once, when it is pressed.
struct JoyOrders {
  std::optional<aibo_driver::WalkVelocity> walk;  ///< none: the joystick does not steer, others may
  std::optional<HeadVelocity> head;               ///< none: the same
  bool stop = false;
  bool release = false;
  bool take_picture = false;
  std::string motion;   ///< its name, or empty
  std::string posture;  ///< its name, or empty
};

/// Turns the state of a joystick into orders.
///
/// Robot safety: nothing moves unless the dead-man button is pressed. After a stop or a release it has to be let go and
/// pressed again, so that a stick that is still deflected does not make the robot walk on.
class JoySteering {
 public:
  explicit JoySteering(const JoyMapping& mapping) : mapping_(mapping) {}

  /// @param axes -1..1
  /// @param buttons 0 or 1
  JoyOrders read(const std::vector<float>& axes, const std::vector<int>& buttons);

  /// What is wrong with a joystick of so many axes and buttons; empty if nothing. Such a joystick only stops the robot.
  std::string problem(std::size_t axes, std::size_t buttons) const;

 private:
  bool isDeadManPressed(const std::vector<float>& axes, const std::vector<int>& buttons);
  void readSticks(bool is_pressed, const std::vector<float>& axes, JoyOrders* orders);
  void readButtons(bool is_pressed, const std::vector<int>& buttons, JoyOrders* orders);
  bool isNew(const std::vector<int>& buttons, int button) const;
  double deflection(const std::vector<float>& axes, int axis) const;
  int lastAxis() const;
  int lastButton() const;

  const JoyMapping mapping_;
  std::vector<int> buttons_;  ///< as read last
  bool steers_ = false;
  bool is_halted_ = false;  ///< by a stop or a release, until the dead-man button is let go
};

}  // namespace teleop

#endif  // AIBO_DRIVER_TOOLS_TELEOP_JOY_STEERING_H
