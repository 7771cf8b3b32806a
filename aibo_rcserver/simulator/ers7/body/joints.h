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

/// Where a joint is, in microradian. A posture of our own: it stands on bent legs, the feet under shoulders and hips
/// and kStandingHeight below them, and looks at the ball.
/// @param joint a name of robot_model.h
/// @throw std::out_of_range if the ERS-7 has no such joint
int restingPosition(const std::string& joint);

/// The same of the head: it looks at the ball, and past it at the station.
HeadAngles restingHead();

/// Begins in the resting posture, without power. Joints do not hit each other: that is for those to
/// prevent who move them. Joints are in the order of the robot's table.
class Joints {
 public:
  /// @param seed of the errors that the encoders make. The same seed and commands give the same readings.
  Joints(const robot_model::RobotModel& model, std::uint64_t seed);

  std::vector<Joint>& all() { return joints_; }
  const std::vector<Joint>& all() const { return joints_; }

  /// @param name of the joint in robot_model.h
  /// @throw std::invalid_argument if there is no such joint
  Joint& named(const std::string& name);
  const Joint& named(const std::string& name) const;

  /// Power of all motors.
  void setPower(bool on);

  /// 8 ms pass.
  void passFrame();

  /// Where the head is.
  HeadAngles head() const;

  /// Where the legs are, by Leg.
  std::array<LegAngles, kLegs> legs() const;

 private:
  const robot_model::RobotModel& model_;
  std::mt19937_64 random_;
  std::vector<Joint> joints_;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_JOINTS_H
