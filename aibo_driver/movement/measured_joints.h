/// @file measured_joints.h
#ifndef AIBO_DRIVER_MOVEMENT_MEASURED_JOINTS_H
#define AIBO_DRIVER_MOVEMENT_MEASURED_JOINTS_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "aibo_driver/telemetry.h"
#include "movement/joint_table.h"

namespace aibo_driver::movement {

/// Where a joint was last measured.
struct MeasuredJoint {
  std::size_t index = 0;                          ///< in the JointTable
  double position = 0;                            ///< rad
  double velocity = 0;                            ///< rad/s; 0 until the second measurement
  std::chrono::steady_clock::time_point arrival;  ///< of the measurement
  std::optional<double> duty = std::nullopt;      ///< of its motor, -1..1; empty if the robot does not report it
};

/// The last measured position and velocity of each joint. From any thread.
class MeasuredJoints {
 public:
  /// @param table must outlive the object
  explicit MeasuredJoints(const JointTable& table);

  /// Computes velocities from two positions and the robot's own time, or the time of arrival if the telemetry has no
  /// frame number. Joints that are not in the table are left out.
  /// @return the joints of this telemetry
  std::vector<MeasuredJoint> update(const Telemetry& telemetry);

  /// Forgets everything, for when the connection is lost.
  void clear();

  /// Empty if the joint has not been measured yet.
  std::optional<MeasuredJoint> find(std::size_t index) const;

 private:
  struct Entry {
    MeasuredJoint joint;
    std::optional<std::uint32_t> frame_number;
  };

  const JointTable& table_;
  mutable std::mutex mutex_;
  std::vector<std::optional<Entry>> entries_;  ///< by index
};

}  // namespace aibo_driver::movement

#endif  // AIBO_DRIVER_MOVEMENT_MEASURED_JOINTS_H
