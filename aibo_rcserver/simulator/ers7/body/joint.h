/// @file joint.h
/// One servo of the simulated robot.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_BODY_JOINT_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_BODY_JOINT_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>

#include <array>

#include "robot_model/robot_model.h"

namespace simulated_ers7 {

/// A motor that is driven in proportion to how far its joint is from where it was commanded, and a joint that turns in
/// proportion to that, up to its highest speed. Angles are in microradian, time in OPEN-R frames of 8 ms.
///
/// Except for limits and highest speed (robot_model.h) the numbers are our choice, for a quick servo that does not
/// overshoot:
/// - With the standard gains the motor runs at full duty from 3 frames' way at highest speed on, and closes three
///   quarters of the gap to the speed that goes with its duty in each frame. So a joint follows a command that moves
///   steadily at a distance of 3 of its steps, 24 ms behind, and settles by half in each frame at the end. A lower
///   proportional gain makes it softer; the other gains and the shifts change nothing.
/// - A joint carries no weight. It stops at once when its gain or the power goes off, and stays where it is.
/// - A command does not move a joint whose gain is off; it counts when the gain goes on. Then, as after any command far
///   from where the joint is, it runs there at its highest speed, as a robot's joint snaps. A motor that pushes against
///   something shows it by its duty alone: no document of Sony's says that a call fails.
class Joint {
 public:
  /// How many readings are kept: as many as one OSensorFrameVectorData carries.
  static constexpr int kReadings = 4;

  /// Reading of the encoder, in steps of 0.05 degree; what is measured is wrong by up to one of them.
  static constexpr int kEncoderStep = 873;

  /// What the motor's full duty is reported as, forward; as Tekkotsu reads OJointValue::pwmDuty.
  static constexpr int kFullDuty = 512;

  /// At rest, with gain and power off and all gains 0, commanded to where it is.
  /// @param model must outlive the joint
  Joint(const robot_model::Joint& model, int position);

  const robot_model::Joint& model() const { return model_; }

  /// @name Level2 Reference Guide, pages 70 and 71
  /// @{

  /// @return oGAIN_DISABLED, and nothing is set, if the gain is not effective
  OStatus setGains(const robot_model::PidGains& gains);

  /// Makes the gain effective. It is 0 until setGains().
  void enableGain() { gain_enabled_ = true; }

  /// Makes the gain 0 and ineffective.
  void disableGain();
  /// @}

  /// Without power no gain has an effect; it has again when the power is back.
  void setPower(bool on) { powered_ = on; }

  /// Where to go from the next frame on. Beyond the mechanical limits the motor stalls at the stop.
  void command(int position) { reference_ = position; }

  /// Something holds the joint fast, or no longer does.
  void jam(bool jammed) { jammed_ = jammed; }

  /// 8 ms pass.
  /// @param error_of_reading what is measured at the end minus what is true
  void passFrame(int error_of_reading);

  /// Where the joint is, without the encoder's error; not a whole number while it moves.
  double position() const { return position_; }

  /// What was measured at the end of each of the last frames, the last one last. Frames before the first show the joint
  /// where it was put. `signal` and `refSignal` count the encoder's steps from the lower mechanical limit.
  const std::array<OJointValue, kReadings>& readings() const { return readings_; }

 private:
  bool isDriven() const { return powered_ && gain_enabled_; }
  void drive();
  void move();
  OJointValue read(int error_of_reading) const;

  const robot_model::Joint& model_;
  const double highest_step_;  ///< microradian a frame
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
