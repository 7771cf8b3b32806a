/// @file battery.h
#ifndef AIBO_DRIVER_BATTERY_H
#define AIBO_DRIVER_BATTERY_H

#include <sensor_msgs/BatteryState.h>

#include <chrono>
#include <optional>

#include "aibo_driver/telemetry.h"
#include "robot_model/robot_model.h"

namespace aibo_driver {

/// Makes messages of how full the battery is. What the robot does not tell is NaN or unknown.
class Battery {
 public:
  using Message = sensor_msgs::BatteryState;

  /// A charge that lasts for more than an hour need not be told more often.
  static constexpr std::chrono::seconds kPeriod{1};

  /// @param sensor must outlive the object, as the tables of robot_model do
  explicit Battery(const robot_model::Sensor& sensor) : sensor_(sensor) {}

  /// @return without a header; nothing if the telemetry tells nothing of the battery, or too soon after the last message
  std::optional<Message> read(const Telemetry& telemetry);

 private:
  const robot_model::Sensor& sensor_;
  std::optional<std::chrono::steady_clock::time_point> last_;  ///< arrival of what the last message was made of
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_BATTERY_H
