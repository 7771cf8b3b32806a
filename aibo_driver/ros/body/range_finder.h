/// @file range_finder.h
#ifndef AIBO_DRIVER_ROS_BODY_RANGE_FINDER_H
#define AIBO_DRIVER_ROS_BODY_RANGE_FINDER_H

#include <sensor_msgs/Range.h>

#include <optional>

#include "aibo_driver/telemetry.h"
#include "robot_model/robot_model.h"

namespace aibo_driver::node {

/// Makes messages of what an infrared range finder measured. Out of its range is told as REP 117 wants it: -inf when
/// something is too near to be measured, inf when nothing is near enough.
class RangeFinder {
 public:
  using Message = sensor_msgs::Range;

  /// For rviz and for costmaps. The beam of such a sensor is narrow, but no source tells how narrow: 2 degrees.
  static constexpr float kFieldOfView = 0.035F;  // rad

  /// @param sensor must outlive the object, as the tables of robot_model do
  explicit RangeFinder(const robot_model::Sensor& sensor) : sensor_(sensor) {}

  /// @return without a header; nothing if the telemetry tells nothing of this sensor
  std::optional<Message> read(const Telemetry& telemetry) const;

 private:
  const robot_model::Sensor& sensor_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_BODY_RANGE_FINDER_H
