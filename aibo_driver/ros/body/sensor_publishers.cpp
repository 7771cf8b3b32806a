#include "ros/body/sensor_publishers.h"

#include <cstdint>
#include <utility>

#include "ros/body/accelerometer.h"
#include "ros/body/battery.h"
#include "ros/body/range_finder.h"
#include "ros/body/touch_sensors.h"

namespace aibo_driver::node {
namespace {

// Of each subscriber, as that of joint_states.
constexpr std::uint32_t kQueueSize = 5;

constexpr const char* kBaseFrame = "base_link";

// Of those that every robot has.
const robot_model::Sensor& sensorOf(const robot_model::RobotModel& model, const char* name) {
  return model.sensors[robot_model::findSensorByName(model, name)];
}

}  // namespace

SensorPublishers::SensorPublishers(const ros::NodeHandle& handle, const robot_model::RobotModel& model,
                                   TelemetryStamper stamp_of)
    : handle_(handle), stamp_of_(std::move(stamp_of)) {
  const std::string range_prefix = "range_";
  for (int i = 0; i < model.number_of_sensors; ++i) {
    const robot_model::Sensor& sensor = model.sensors[i];
    const std::string name = sensor.name;
    if (sensor.kind == robot_model::SENSOR_DISTANCE) {
      add("range/" + name.substr(range_prefix.size()), name + "_link", RangeFinder(sensor));
    } else if (sensor.kind == robot_model::SENSOR_CHARGE) {
      add(name, kBaseFrame, Battery(sensor, sensorOf(model, "temperature")));
    }
  }
  add("touch", kBaseFrame, TouchSensors(model));
  add("imu/data_raw", "imu_link",
      Accelerometer(sensorOf(model, "acceleration_front_back"), sensorOf(model, "acceleration_right_left"),
                    sensorOf(model, "acceleration_up_down")));
}

void SensorPublishers::publish(const Telemetry& telemetry) {
  for (const auto& publisher : publishers_) {
    publisher(telemetry);
  }
}

template <typename Sensor>
void SensorPublishers::add(const std::string& topic, const std::string& frame_id, Sensor sensor) {
  using Message = typename Sensor::Message;
  publishers_.push_back([this, publisher = handle_.advertise<Message>(topic, kQueueSize), frame_id,
                         sensor = std::move(sensor)](const Telemetry& telemetry) mutable {
    if (const auto reading = sensor.read(telemetry)) {
      const auto message = boost::make_shared<Message>(*reading);
      message->header.stamp = stamp_of_(telemetry);
      message->header.frame_id = frame_id;
      publisher.publish(boost::shared_ptr<const Message>(message));
    }
  });
}

}  // namespace aibo_driver::node
