#include "node/body/sensor_messages.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace aibo_driver::node {
namespace {

// A sensor, and the fields of the message that belong to it.
struct Field {
  const char* sensor;
  std::uint8_t Touch::*touched;
  float Touch::*strength;  // null for a switch
};

constexpr Field kFields[] = {
    {"paw_left_front", &Touch::paw_left_front, nullptr},
    {"paw_left_hind", &Touch::paw_left_hind, nullptr},
    {"paw_right_front", &Touch::paw_right_front, nullptr},
    {"paw_right_hind", &Touch::paw_right_hind, nullptr},
    {"chin", &Touch::chin, nullptr},
    {"head_touch", &Touch::head, &Touch::head_strength},
    {"back_front", &Touch::back_front, &Touch::back_front_strength},
    {"back_middle", &Touch::back_middle, &Touch::back_middle_strength},
    {"back_rear", &Touch::back_rear, &Touch::back_rear_strength},
    {"back", &Touch::back_middle, nullptr},  // an ERS-210 has only this sensor on its back
};

Touch untouched() {
  Touch message;
  for (const Field& field : kFields) {
    if (field.strength != nullptr) {
      message.*field.strength = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return message;
}

}  // namespace

const robot_model::Sensor& sensorOf(const robot_model::RobotModel& model, const char* name) {
  return model.sensors[robot_model::findSensorByName(model, name)];
}

std::optional<double> readingOf(const robot_model::Sensor& sensor, const Telemetry& telemetry) {
  const auto found =
      std::find_if(telemetry.sensors.begin(), telemetry.sensors.end(),
                   [&sensor](const aibo_client::SensorReading& reading) { return reading.id == sensor.identifier; });
  if (found == telemetry.sensors.end()) {
    return std::nullopt;
  }
  return found->value;
}

std::optional<sensor_msgs::JointState> JointStates::read(const Telemetry& telemetry) const {
  Message message;
  for (const aibo_client::JointReading& reading : telemetry.joints) {
    const std::optional<std::size_t> index = table_.findById(reading.id);
    const auto joint = index ? measured_.find(*index) : std::nullopt;
    if (!joint) {
      continue;
    }
    message.name.push_back(table_[*index].name);
    message.position.push_back(joint->position);
    message.velocity.push_back(joint->velocity);
    if (joint->duty) {
      message.effort.push_back(*joint->duty);
    }
  }
  if (message.effort.size() != message.name.size()) {
    // A message has to have the effort of all its joints or of none.
    message.effort.clear();
  }
  return message.name.empty() ? std::nullopt : std::optional<Message>(std::move(message));
}

std::optional<sensor_msgs::Range> RangeFinder::read(const Telemetry& telemetry) const {
  const std::optional<double> distance = readingOf(sensor_, telemetry);
  if (!distance) {
    return std::nullopt;
  }
  const double shortest = sensor_.lowest / 1e6;
  const double longest = sensor_.highest / 1e6;
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Message message;
  message.radiation_type = Message::INFRARED;
  message.field_of_view = kFieldOfView;
  message.min_range = static_cast<float>(shortest);
  message.max_range = static_cast<float>(longest);
  // If the obstacle is beyond the sensor's limit, the sensor reports the limit.
  message.range = *distance <= shortest ? -kInfinity : *distance >= longest ? kInfinity : static_cast<float>(*distance);
  return message;
}

std::optional<sensor_msgs::Imu> Accelerometer::read(const Telemetry& telemetry) {
  if (connection_ != telemetry.connection_number) {
    connection_ = telemetry.connection_number;
    values_ = {};
  }
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    const std::optional<double> value = readingOf(*sensors_[i], telemetry);
    values_[i] = value ? value : values_[i];
  }
  const auto [backwards, left, down] = values_;
  if (!backwards || !left || !down) {
    return std::nullopt;
  }
  values_ = {};
  Message message;
  message.linear_acceleration.x = -*backwards;
  message.linear_acceleration.y = *left;
  message.linear_acceleration.z = -*down;
  // A covariance of -1 means that the message has no such measurement. The covariance of the acceleration stays 0,
  // which means unknown (sensor_msgs/Imu).
  message.orientation_covariance[0] = -1;
  message.angular_velocity_covariance[0] = -1;
  return message;
}

TouchSensors::TouchSensors(const robot_model::RobotModel& model) : message_(untouched()) {
  for (const Field& field : kFields) {
    const int index = robot_model::findSensorByName(model, field.sensor);
    if (index != robot_model::NO_SENSOR) {
      parts_.push_back({&model.sensors[index], field.touched, field.strength});
    }
  }
}

std::optional<Touch> TouchSensors::read(const Telemetry& telemetry) {
  if (connection_ != telemetry.connection_number) {
    connection_ = telemetry.connection_number;
    message_ = untouched();
  }
  bool anything = false;
  for (const Part& part : parts_) {
    const std::optional<double> value = readingOf(*part.sensor, telemetry);
    if (!value) {
      continue;
    }
    anything = true;
    message_.*part.touched = robot_model::isPressed(*part.sensor, *value, message_.*part.touched != 0);
    if (part.strength != nullptr) {
      message_.*part.strength = static_cast<float>(*value);
    }
  }
  return anything ? std::optional<Touch>(message_) : std::nullopt;
}

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
