#include "battery.h"

#include <limits>

#include "sensor_reading.h"

namespace aibo_driver {

std::optional<sensor_msgs::BatteryState> Battery::read(const Telemetry& telemetry) {
  const std::optional<double> charge = readingOf(sensor_, telemetry);
  if (!charge || (last_ && telemetry.arrival - *last_ < kPeriod)) {
    return std::nullopt;
  }
  last_ = telemetry.arrival;
  constexpr float kNotMeasured = std::numeric_limits<float>::quiet_NaN();
  Message message;
  message.voltage = kNotMeasured;
  message.current = kNotMeasured;
  message.charge = kNotMeasured;
  message.capacity = kNotMeasured;
  message.design_capacity = kNotMeasured;
  message.percentage = static_cast<float>(*charge);
  message.power_supply_status = Message::POWER_SUPPLY_STATUS_UNKNOWN;
  message.power_supply_health = Message::POWER_SUPPLY_HEALTH_UNKNOWN;
  message.power_supply_technology = Message::POWER_SUPPLY_TECHNOLOGY_UNKNOWN;
  message.present = true;
  return message;
}

}  // namespace aibo_driver
