#include "ros/body/range_finder.h"

#include <limits>

#include "ros/body/sensor_reading.h"

namespace aibo_driver::node {

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
  // At its limits the sensor stays, whatever lies beyond them.
  message.range = *distance <= shortest ? -kInfinity : *distance >= longest ? kInfinity : static_cast<float>(*distance);
  return message;
}

}  // namespace aibo_driver::node
