/// @file joint.h
/// One servo of the simulated robot.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_BODY_JOINT_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_BODY_JOINT_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>

#include <array>
#include <optional>

#include "robot_model/robot_model.h"

namespace simulated_ers7 {

/// The motor's duty is proportional to the distance between position and command. The speed is proportional to the
/// duty, up to the joint's highest speed. Angles are in microradians, time in OPEN-R frames of 8 ms.
///
/// Limits and highest speeds come from robot_model.h. All other properties are our choice, for a quick servo that does
/// not overshoot:
/// - With the standard gains, the motor has full duty if the distance is at least what the joint moves in 3 frames at
/// its highest speed. In each frame, the difference between the speed and the duty's speed shrinks by three quarters.
/// So a joint follows a steadily moving command with a lag of 3 frames (24 ms), and at the end the distance halves in
/// each frame. A lower proportional gain makes the joint softer; the other gains and the shifts have no effect.
/// - A joint carries no weight. Without gain or power it stops at once and stays where it is.
/// - A joint without gain does not move, but remembers its command. When the gain returns, it snaps to the command at
/// its
///   highest speed, as a real joint does. A blocked motor shows only in its duty, because Sony documents no call that
///   fails.
class Joint {
 public:
  /// Number of readings in an OSensorFrameVectorData.
  static constexpr int kReadings = 4;

  /// 0.05 degree in microradians. Readings have errors of up to one step.
  static constexpr int kEncoderStep = 873;

  /// The reported value at full duty forward. Tekkotsu takes OJointValue::pwmDuty in the same way.
  static constexpr int kFullDuty = 512;

  /// At first, the joint rests without gain or power. All gains are 0, and the command is the joint's position.
  /// @param model must outlive the joint
  Joint(const robot_model::Joint& model, int position);

  const robot_model::Joint& model() const { return model_; }

  /// Sets the gains (Level2 Reference Guide, pages 70 and 71).

  /// @return oGAIN_DISABLED, and no gain is set, if the gain is not effective
  OStatus setGains(const robot_model::PidGains& gains);

  /// Enables the gain, which is 0 until setGains().
  void enableGain() { gains_ = gains_.value_or(robot_model::PidGains()); }

  void disableGain() { gains_.reset(); }

  /// Switches the power. Without it, the gain has no effect.
  void setPower(bool on) { powered_ = on; }

  /// Sets the target from the next frame on. Beyond the mechanical limits, the motor stalls at the stop.
  void command(int position) { reference_ = position; }

  void jam(bool jammed) { jammed_ = jammed; }

  /// Call this every 8 ms.
  /// @param error_of_reading the measured position minus the true one
  void passFrame(int error_of_reading);

  /// The true position, without the encoder's error. While the joint moves, it is not a whole number.
  double position() const { return position_; }

  /// One reading at the end of each of the last frames, in order of time. Before the first frame, they have the first
  /// position. `signal` and `refSignal` count encoder steps from the lower mechanical limit.
  const std::array<OJointValue, kReadings>& readings() const { return readings_; }

 private:
  bool isDriven() const { return powered_ && gains_; }
  void drive();
  void move();
  OJointValue read(int error_of_reading) const;

  const robot_model::Joint& model_;
  const double highest_step_;                   ///< microradians per frame
  std::optional<robot_model::PidGains> gains_;  ///< empty while the gain is disabled
  bool powered_ = false;
  bool jammed_ = false;
  int reference_;
  double position_;
  double step_ = 0;  ///< the step of the last frame
  double duty_ = 0;  ///< -1..1
  std::array<OJointValue, kReadings> readings_;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_JOINT_H
