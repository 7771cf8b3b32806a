/// @file joint_command_filter.h
#ifndef AIBO_DRIVER_MOVEMENT_JOINT_COMMAND_FILTER_H
#define AIBO_DRIVER_MOVEMENT_JOINT_COMMAND_FILTER_H

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "movement/joint_table.h"
#include "movement/measured_joints.h"

namespace aibo_driver::movement {

/// The approach speed in rad/s, unless the user sets another one.
constexpr double kUsualApproachSpeed = 0.5;

/// Protects the joints from harmful commands, as docs/ros_interface.md says ("Guard rails"). If a joint is named twice,
/// its last position counts. Limits that depend on other joints are left to the robot.
///
/// Approach: the first command to a joint may come from a program that does not know the robot's posture. For example,
/// joint_state_publisher_gui begins by commanding every joint to 0 or to its middle. So the joint moves there at the
/// approach speed. The approach ends after the time that this takes, or when a new target comes while the measured
/// joint is near the old one. A new target during the approach makes it longer, but at most as long as the joint takes
/// for its whole range.
class JointCommandFilter {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  /// @param table, measured must outlive the filter
  /// @param approach_speed rad/s
  JointCommandFilter(const JointTable& table, const MeasuredJoints& measured, double approach_speed);

  /// Filters one command. Its arrays are those of sensor_msgs/JointState.
  /// @param positions rad, one for each name
  /// @param velocities rad/s, one for each name, or empty; the sign does not matter, and 0 means that none is given
  /// @param[in,out] targets for each joint that may move, gets a target with a speed, in place of an earlier target
  /// @return what was left out or clamped, and why, in one sentence for each joint, without numbers that vary
  std::vector<std::string> filter(const std::vector<std::string>& names, const std::vector<double>& positions,
                                  const std::vector<double>& velocities, SteadyTime now, JointTargets* targets);

  /// Call this when the robot may have any posture, as after a new connection. All joints are approached again.
  void startApproach();

  /// Call this when the joints are stopped. Those on their approach begin it again with the next command.
  void interruptApproach(SteadyTime now);

 private:
  /// The movement of a joint to the first target that it was given.
  struct Approach {
    double target = 0;
    SteadyTime end;
    SteadyTime latest_end;
  };

  aibo_client::JointTarget targetFor(std::size_t index, double position, double velocity, SteadyTime now);
  bool approaches(std::size_t index, double target, double speed, SteadyTime now);
  double distance(std::size_t index, double target) const;
  bool isNear(std::size_t index, double target) const;

  const JointTable& table_;
  const MeasuredJoints& measured_;
  const double approach_speed_;
  std::vector<std::optional<Approach>> approaches_;  ///< the joint's index is the position
};

}  // namespace aibo_driver::movement

#endif  // AIBO_DRIVER_MOVEMENT_JOINT_COMMAND_FILTER_H
