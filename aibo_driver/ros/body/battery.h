/// @file battery.h
#ifndef AIBO_DRIVER_ROS_BODY_BATTERY_H
#define AIBO_DRIVER_ROS_BODY_BATTERY_H

#include <sensor_msgs/BatteryState.h>

#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>

#include "aibo_driver/telemetry.h"
#include "robot_model/robot_model.h"

namespace aibo_driver::node {

/// Makes messages of how full and how warm the battery is. What the robot does not tell is NaN or unknown.
class Battery {
 public:
  using Message = sensor_msgs::BatteryState;

  /// A charge that lasts for more than an hour need not be told more often.
  static constexpr std::chrono::seconds kPeriod{1};

  /// The sensors must outlive the object, as the tables of robot_model do.
  Battery(const robot_model::Sensor& charge, const robot_model::Sensor& temperature)
      : charge_sensor_(charge), temperature_sensor_(temperature) {}

  /// @return without a header; nothing if the telemetry does not tell the charge, or too soon after the last message.
  ///   The temperature is the one that was told last over this connection: a version 1 server tells one by one.
  std::optional<Message> read(const Telemetry& telemetry);

 private:
  static constexpr float kNotMeasured = std::numeric_limits<float>::quiet_NaN();

  const robot_model::Sensor& charge_sensor_;
  const robot_model::Sensor& temperature_sensor_;
  float temperature_ = kNotMeasured;  ///< degree Celsius
  std::uint64_t connection_ = 0;
  std::optional<std::chrono::steady_clock::time_point> last_;  ///< arrival of what the last message was made of
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_BODY_BATTERY_H
