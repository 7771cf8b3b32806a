/// @file joint_command_filter.h
#ifndef AIBO_DRIVER_JOINTS_JOINT_COMMAND_FILTER_H
#define AIBO_DRIVER_JOINTS_JOINT_COMMAND_FILTER_H

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "joints/joint_link.h"
#include "joints/joint_table.h"
#include "joints/measured_joints.h"

namespace aibo_driver::joints {

/// What a user asks of some joints, unchecked. Arrays as in sensor_msgs/JointState.
struct JointCommand {
  std::vector<std::string> names;
  std::vector<double> positions;   ///< rad
  std::vector<double> velocities;  ///< rad/s, or empty; the sign does not matter, 0 means that none is given
};

/// What is left of a command.
struct FilteredCommand {
  std::vector<JointOrder> orders;     ///< each joint once
  std::vector<std::string> refusals;  ///< what was left out and why, a sentence each, without numbers that vary
};

/// The guard rails between users and joints.
///
/// - A command whose arrays do not fit together is refused. A joint that is not there, or whose position or velocity is
///   no finite number, is left out; the others are carried out. Of two positions for one joint the last counts.
/// - Positions are clamped to the joint's limits. Limits that depend on other joints are the robot's to keep.
/// - No joint moves faster than its speed limit, or the velocity given.
/// - Approach: the first command to a joint may come from a program that knows nothing of the robot's posture, such as
///   joint_state_publisher_gui, which begins by commanding every joint to 0 or to its middle. So the joint goes there
///   at the approach speed. After the time that this takes, or once it is told to go on from where it is measured near,
///   its speed limit alone holds. A target that moves on meanwhile makes it last longer, but not longer than the
///   joint's longest way takes.
class JointCommandFilter {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  /// @param table, measured must outlive the filter
  /// @param approach_speed rad/s
  JointCommandFilter(const JointTable& table, const MeasuredJoints& measured, double approach_speed);

  FilteredCommand filter(const JointCommand& command, SteadyTime now);

  /// The posture may be any from now on, as after a new connection: all joints are to be approached again.
  void startApproach();

 private:
  /// A joint's way to the first place it was told.
  struct Approach {
    double target = 0;
    SteadyTime end;
    SteadyTime latest_end;
  };

  JointOrder orderFor(std::size_t index, double position, double velocity, SteadyTime now);
  bool approaches(std::size_t index, double target, double speed, SteadyTime now);
  double distance(std::size_t index, double target) const;
  bool isNear(std::size_t index, double target) const;

  const JointTable& table_;
  const MeasuredJoints& measured_;
  const double approach_speed_;
  std::vector<std::optional<Approach>> approaches_;  ///< by index
};

}  // namespace aibo_driver::joints

#endif  // AIBO_DRIVER_JOINTS_JOINT_COMMAND_FILTER_H
