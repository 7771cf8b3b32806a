/// @file sensor_reading.h
#ifndef AIBO_DRIVER_ROS_BODY_SENSOR_READING_H
#define AIBO_DRIVER_ROS_BODY_SENSOR_READING_H

#include <algorithm>
#include <optional>

#include "aibo_driver/telemetry.h"
#include "robot_model/robot_model.h"

namespace aibo_driver::node {

/// What a sensor measured; nothing if this telemetry does not tell.
inline std::optional<double> readingOf(const robot_model::Sensor& sensor, const Telemetry& telemetry) {
  const auto found = std::find_if(telemetry.sensors.begin(), telemetry.sensors.end(),
                                  [&sensor](const SensorReading& reading) { return reading.id == sensor.identifier; });
  if (found == telemetry.sensors.end()) {
    return std::nullopt;
  }
  return found->value;
}

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_BODY_SENSOR_READING_H
