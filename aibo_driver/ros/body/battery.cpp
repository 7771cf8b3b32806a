#include "ros/body/battery.h"

#include "ros/body/sensor_reading.h"

namespace aibo_driver::node {

std::optional<sensor_msgs::BatteryState> Battery::read(const Telemetry& telemetry) {
  if (connection_ != telemetry.connection_number) {
    connection_ = telemetry.connection_number;
    temperature_ = kNotMeasured;
  }
  temperature_ = static_cast<float>(readingOf(temperature_sensor_, telemetry).value_or(temperature_));
  const std::optional<double> charge = readingOf(charge_sensor_, telemetry);
  if (!charge || (last_ && telemetry.arrival - *last_ < kPeriod)) {
    return std::nullopt;
  }
  last_ = telemetry.arrival;
  Message message;
  message.voltage = kNotMeasured;
  message.temperature = temperature_;
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

}  // namespace aibo_driver::node
