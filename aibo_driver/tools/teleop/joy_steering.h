/// @file joy_steering.h
#ifndef AIBO_DRIVER_TOOLS_TELEOP_JOY_STEERING_H
#define AIBO_DRIVER_TOOLS_TELEOP_JOY_STEERING_H

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "aibo_client/walk.h"
#include "tools/teleop/key_steering.h"

namespace teleop {

/// Where the head looks, in rad, or how fast it turns, in rad/s.
struct PanTilt {
  double pan = 0;   ///< positive to the left
  double tilt = 0;  ///< positive up
};

/// The place of an axis or button that does not exist.
constexpr int kNoPlace = -1;

/// Which parts of a joystick or gamepad do what. A part is named by its place in sensor_msgs/Joy, from 0 on, or
/// kNoPlace. config/joy.yaml sets them.
struct JoyMapping {
  int dead_man_button = 4;              ///< nothing moves unless this is pressed; not kNoPlace
  int forward_axis = 1;                 ///< positive is forward
  int turn_axis = 0;                    ///< positive is to the left
  int left_axis = 6;                    ///< walks sideways; positive is to the left
  int pan_axis = 3;                     ///< turns the head; positive is to the left
  int tilt_axis = 4;                    ///< positive is up
  int stop_button = 1;                  ///< works without the dead-man button
  int release_button = kNoPlace;        ///< lets the robot move again after a stop; needs the dead-man button
  int picture_button = 0;               ///< works without the dead-man button
  std::map<std::string, int> motions;   ///< buttons; the key is the name of the motion
  std::map<std::string, int> postures;  ///< buttons; the key is the name of the service: stand, sit, rest
  Speeds speeds;                        ///< at full deflection
  double head_speed = 1.0;              ///< rad/s, at full deflection
  double dead_zone = 0.1;               ///< 0..0.9; a smaller deflection counts as none
};

/// Finds out whether a button has two uses. One press would then do both, such as release the robot and let it walk.
/// @return the problem, as a sentence for the user; empty if there is none
std::string problemOf(const JoyMapping& mapping);

/// What the robot should do. Each button counts once, when it is pressed.
struct JoyOrders {
  std::optional<aibo_client::WalkVelocity> walk;  ///< empty: the joystick does not steer, so other nodes may
  std::optional<PanTilt> head;                    ///< empty: the joystick does not turn the head, so other nodes may
  bool stop = false;
  bool release = false;
  bool take_picture = false;
  std::string motion;   ///< the motion's name, or empty
  std::string posture;  ///< the posture's name, or empty
};

/// Turns the state of a joystick into orders.
///
/// For safety, nothing moves unless the dead-man button is pressed. After a stop or a release it has to be released and
/// pressed again. Without this, a stick that is still deflected would make the robot walk on.
class JoySteering {
 public:
  explicit JoySteering(const JoyMapping& mapping);

  /// @param axes -1..1
  /// @param buttons 0 or 1
  JoyOrders read(const std::vector<float>& axes, const std::vector<int>& buttons);

  /// What is wrong with a joystick that has this many axes and buttons. It is empty if all is well. A joystick with a
  /// problem can only stop the robot.
  std::string problem(std::size_t axes, std::size_t buttons) const;

 private:
  void readSticks(bool is_pressed, const std::vector<float>& axes, JoyOrders* orders);
  void readButtons(bool is_pressed, const std::vector<int>& buttons, JoyOrders* orders);
  bool isNew(const std::vector<int>& buttons, int button) const;
  double deflection(const std::vector<float>& axes, int axis) const;

  const JoyMapping mapping_;
  const int last_axis_;
  const int last_button_;
  std::vector<int> buttons_;  ///< the buttons in the last message
  bool steers_ = false;
  bool is_halted_ = false;  ///< the robot was stopped or released; true until the dead-man button is up
};

/// Turns velocities of the head into positions to command. The positions begin where the head is measured, end at the
/// limits of an ERS-7's joints, and never run far ahead of the head.
class HeadSteering {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// Call this with the measured position of the head.
  void measured(const PanTilt& position);

  /// Call this several times a second.
  /// @param velocity empty: the head is not steered, and others may move it
  /// @return the position to command; empty if the head is not steered, or has not been measured yet
  std::optional<PanTilt> steer(const std::optional<PanTilt>& velocity, TimePoint now);

 private:
  std::optional<PanTilt> measured_;
  std::optional<PanTilt> target_;  ///< empty while the head is not steered
  TimePoint last_;
};

}  // namespace teleop

#endif  // AIBO_DRIVER_TOOLS_TELEOP_JOY_STEERING_H
