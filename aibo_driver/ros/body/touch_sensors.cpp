#include "ros/body/touch_sensors.h"

#include <limits>

#include "ros/body/sensor_reading.h"

namespace aibo_driver::node {
namespace {

// Where a message tells of a sensor.
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
    {"back", &Touch::back_middle, nullptr},  // the only one of an ERS-210
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

TouchSensors::TouchSensors(const robot_model::RobotModel& model) : model_(model), message_(untouched()) {}

std::optional<Touch> TouchSensors::read(const Telemetry& telemetry) {
  if (connection_ != telemetry.connection_number) {
    connection_ = telemetry.connection_number;
    message_ = untouched();
  }
  bool anything = false;
  for (const Field& field : kFields) {
    const int index = robot_model::findSensorByName(model_, field.sensor);
    if (index == robot_model::NO_SENSOR) {
      continue;
    }
    const robot_model::Sensor& sensor = model_.sensors[index];
    const std::optional<double> value = readingOf(sensor, telemetry);
    if (!value) {
      continue;
    }
    anything = true;
    message_.*field.touched = robot_model::isPressed(sensor, *value, message_.*field.touched != 0);
    if (field.strength != nullptr) {
      message_.*field.strength = static_cast<float>(*value);
    }
  }
  return anything ? std::optional<Touch>(message_) : std::nullopt;
}

}  // namespace aibo_driver::node
