/// @file joint.h
/// One servo of the simulated robot.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_BODY_JOINT_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_BODY_JOINT_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>

#include <array>

#include "robot_model/robot_model.h"

namespace simulated_ers7 {

/// The motor's duty is proportional to the distance between the joint's position and its command. The joint's speed is
/// proportional to the duty, up to its highest speed. Angles are in microradian, time in OPEN-R frames of 8 ms.
///
/// Limits and highest speeds come from robot_model.h; the other numbers are our choice, for a quick servo that does not
/// overshoot:
/// - With the standard gains, the motor has full duty if the distance is at least what the joint moves in 3 frames at
///   its highest speed. In each frame the speed approaches the duty's speed by three quarters of the difference. So a
///   joint follows a steadily moving command 3 frames (24 ms) behind, and at the end the distance halves in each frame.
///   A lower proportional gain makes the joint softer; the other gains and the shifts have no effect.
/// - A joint carries no weight. When its gain or the power is switched off, it stops at once and stays where it is.
/// - A command does not move a joint whose gain is off, but takes effect when the gain is switched on. Then, as after
///   any distant command, the joint moves at its highest speed; a real joint snaps the same way. A blocked motor shows
///   only in its duty, because Sony documents no call that fails.
class Joint {
 public:
  /// Number of readings that are kept: those of one OSensorFrameVectorData.
  static constexpr int kReadings = 4;

  /// Step of the encoder, 0.05 degree. Readings are wrong by up to one step.
  static constexpr int kEncoderStep = 873;

  /// Reported value of full duty forward, as Tekkotsu reads OJointValue::pwmDuty.
  static constexpr int kFullDuty = 512;

  /// A joint at rest, with gain and power off and all gains 0, commanded to its position.
  /// @param model must outlive the joint
  Joint(const robot_model::Joint& model, int position);

  const robot_model::Joint& model() const { return model_; }

  /// @name Level2 Reference Guide, pages 70 and 71
  /// @{

  /// @return oGAIN_DISABLED, with nothing set, if the gain is not effective
  OStatus setGains(const robot_model::PidGains& gains);

  /// Makes the gain effective. It is 0 until setGains().
  void enableGain() { gain_enabled_ = true; }

  /// Makes the gain 0 and ineffective.
  void disableGain();
  /// @}

  /// Without power the gain has no effect until the power is back.
  void setPower(bool on) { powered_ = on; }

  /// Sets the target from the next frame on. If it is beyond the mechanical limits, the motor stalls at the stop.
  void command(int position) { reference_ = position; }

  /// Blocks or unblocks the joint.
  void jam(bool jammed) { jammed_ = jammed; }

  /// 8 ms pass.
  /// @param error_of_reading measured minus true position at the end
  void passFrame(int error_of_reading);

  /// The true position, without the encoder's error; not a whole number while the joint moves.
  double position() const { return position_; }

  /// The readings at the end of each of the last frames, the latest one last. Before the first frame they show the
  /// first position. `signal` and `refSignal` count the encoder's steps from the lower mechanical limit.
  const std::array<OJointValue, kReadings>& readings() const { return readings_; }

 private:
  bool isDriven() const { return powered_ && gain_enabled_; }
  void drive();
  void move();
  OJointValue read(int error_of_reading) const;

  const robot_model::Joint& model_;
  const double highest_step_;  ///< microradian per frame
  robot_model::PidGains gains_ = {};
  bool powered_ = false;
  bool gain_enabled_ = false;
  bool jammed_ = false;
  int reference_;
  double position_;
  double step_ = 0;  ///< of the last frame
  double duty_ = 0;  ///< -1..1
  std::array<OJointValue, kReadings> readings_;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_JOINT_H
