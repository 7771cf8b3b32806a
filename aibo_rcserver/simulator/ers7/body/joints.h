/// @file joints.h
/// All servos of the simulated robot, and its first posture.
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

/// The joint's first position, in microradians. The posture is our choice: the robot stands on bent legs, with its feet
/// kStandingHeight below shoulders and hips, and looks at the ball.
/// @param joint the joint's name in robot_model.h
/// @throw std::out_of_range the ERS-7 has no such joint
int restingPosition(const std::string& joint);

/// The head's first angles: it looks at the ball and at the station behind it.
HeadAngles restingHead();

/// All joints, in the order of the robot's table. They begin in the resting posture, without power. A joint that an
/// ERS-7 lacks begins at 0. Collisions between legs and body are not simulated.
class Joints {
 public:
  /// @param seed the seed of the encoders' errors; the same seed and commands give the same readings
  Joints(const robot_model::RobotModel& model, std::uint64_t seed);

  std::vector<Joint>& all() { return joints_; }
  const std::vector<Joint>& all() const { return joints_; }

  /// @param name the joint's name in robot_model.h
  /// @throw std::invalid_argument there is no such joint
  Joint& named(const std::string& name);
  const Joint& named(const std::string& name) const;

  void setPower(bool on);

  /// Call this after each frame of 8 ms.
  void passFrame();

  /// The angles of the head. A robot without neck_tilt has an ERS-7's neck at rest.
  HeadAngles head() const;

  /// The angles of the legs, by Leg.
  std::array<LegAngles, kLegs> legs() const;

 private:
  const robot_model::RobotModel& model_;
  std::mt19937_64 random_;
  std::vector<Joint> joints_;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_JOINTS_H
