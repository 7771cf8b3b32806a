/// @file sensor_publishers.h
#ifndef AIBO_DRIVER_ROS_BODY_SENSOR_PUBLISHERS_H
#define AIBO_DRIVER_ROS_BODY_SENSOR_PUBLISHERS_H

#include <ros/node_handle.h>

#include <functional>
#include <string>
#include <vector>

#include "aibo_driver/telemetry.h"
#include "robot_model/robot_model.h"
#include "ros/telemetry_stamper.h"

namespace aibo_driver::node {

/// Publishes what the robot measures beside its joints: range/NAME, imu/data_raw, touch and battery. Only topics of
/// sensors that the robot has are advertised; a message is published when there is something new for it.
class SensorPublishers {
 public:
  /// @param model must outlive the object
  SensorPublishers(const ros::NodeHandle& handle, const robot_model::RobotModel& model, TelemetryStamper stamp_of);

  /// Never blocks. From one thread at a time.
  void publish(const Telemetry& telemetry);

 private:
  template <typename Sensor>
  void add(const std::string& topic, const std::string& frame_id, Sensor sensor);

  ros::NodeHandle handle_;
  const TelemetryStamper stamp_of_;
  std::vector<std::function<void(const Telemetry&)>> publishers_;  ///< one a topic
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_BODY_SENSOR_PUBLISHERS_H
