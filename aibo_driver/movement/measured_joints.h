/// @file measured_joints.h
#ifndef AIBO_DRIVER_MOVEMENT_MEASURED_JOINTS_H
#define AIBO_DRIVER_MOVEMENT_MEASURED_JOINTS_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "aibo_client/telemetry.h"
#include "movement/joint_table.h"

namespace aibo_driver::movement {

/// The last measurement of a joint.
struct MeasuredJoint {
  double position = 0;                            ///< rad
  double velocity = 0;                            ///< rad/s; 0 until the second measurement
  std::chrono::steady_clock::time_point arrival;  ///< when the measurement arrived
  std::optional<double> duty = std::nullopt;  ///< the duty of its motor, -1..1; empty if the robot does not report it
};

/// The last measured position and velocity of each joint. Any thread may use it.
class MeasuredJoints {
 public:
  /// @param table must outlive the object
  explicit MeasuredJoints(const JointTable& table);

  /// Computes each velocity from two positions and the robot's own time or, if the telemetry has no frame number, the
  /// time of arrival. Joints that are not in the table are ignored.
  void update(const aibo_client::Telemetry& telemetry);

  /// Forgets everything. Call this when the connection is lost.
  void clear();

  /// The last measurement of a joint. It is empty if the joint has not been measured yet.
  std::optional<MeasuredJoint> find(std::size_t index) const;

 private:
  struct Entry {
    MeasuredJoint joint;
    std::optional<std::uint32_t> frame_number;
  };

  const JointTable& table_;
  mutable std::mutex mutex_;
  std::vector<std::optional<Entry>> entries_;  ///< the joint's index is the position
};

}  // namespace aibo_driver::movement

#endif  // AIBO_DRIVER_MOVEMENT_MEASURED_JOINTS_H
