/// @file touch_sensors.h
#ifndef AIBO_DRIVER_ROS_BODY_TOUCH_SENSORS_H
#define AIBO_DRIVER_ROS_BODY_TOUCH_SENSORS_H

#include <aibo_driver/Touch.h>

#include <cstdint>
#include <optional>

#include "aibo_driver/telemetry.h"
#include "robot_model/robot_model.h"

namespace aibo_driver::node {

/// Makes messages of what the switches and touch sensors measured.
class TouchSensors {
 public:
  using Message = Touch;

  /// @param model must outlive the object
  explicit TouchSensors(const robot_model::RobotModel& model);

  /// @return without a header; nothing if the telemetry tells nothing of any of these sensors. Those of which it does
  ///   not tell are as they were told last over this connection.
  std::optional<Message> read(const Telemetry& telemetry);

 private:
  const robot_model::RobotModel& model_;
  Message message_;
  std::uint64_t connection_ = 0;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_BODY_TOUCH_SENSORS_H
