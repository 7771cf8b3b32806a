#include "ros/body/accelerometer.h"

#include <cstddef>

#include "ros/body/sensor_reading.h"

namespace aibo_driver::node {

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
  // Not measured at all; the covariance of the acceleration stays 0, which means unknown (sensor_msgs/Imu).
  message.orientation_covariance[0] = -1;
  message.angular_velocity_covariance[0] = -1;
  return message;
}

}  // namespace aibo_driver::node
