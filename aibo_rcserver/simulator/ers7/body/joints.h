/// @file joints.h
/// All servos of the simulated robot, and the posture in which it is switched on.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_BODY_JOINTS_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_BODY_JOINTS_H

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "robot_model/robot_model.h"
#include "simulator/ers7/body/head_kinematics.h"
#include "simulator/ers7/body/joint.h"
#include "simulator/ers7/body/stance.h"

namespace simulated_ers7 {

/// A joint's position in the resting posture, in microradian. The posture is our own: the robot stands on bent legs,
/// the feet under shoulders and hips and kStandingHeight below them, and looks at the ball.
/// @param joint name as in robot_model.h
/// @throw std::out_of_range if the ERS-7 has no such joint
int restingPosition(const std::string& joint);

/// The head in the resting posture. It looks at the ball and, behind it, the station.
HeadAngles restingHead();

/// Starts in the resting posture, without power. Joints pass through each other; it is up to the objects to avoid that.
/// Joints are in the order of the robot's table.
class Joints {
 public:
  /// @param seed of the encoders' errors. The same seed and commands give the same readings.
  Joints(const robot_model::RobotModel& model, std::uint64_t seed);

  std::vector<Joint>& all() { return joints_; }
  const std::vector<Joint>& all() const { return joints_; }

  /// @param name of the joint in robot_model.h
  /// @throw std::invalid_argument if there is no such joint
  Joint& named(const std::string& name);
  const Joint& named(const std::string& name) const;

  /// Switches the power of all motors.
  void setPower(bool on);

  /// 8 ms pass.
  void passFrame();

  /// The head's angles.
  HeadAngles head() const;

  /// The legs' angles, indexed by Leg.
  std::array<LegAngles, kLegs> legs() const;

 private:
  const robot_model::RobotModel& model_;
  std::mt19937_64 random_;
  std::vector<Joint> joints_;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_JOINTS_H
