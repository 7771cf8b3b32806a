/// @file telemetry_publishers.h
#ifndef AIBO_DRIVER_NODE_BODY_TELEMETRY_PUBLISHERS_H
#define AIBO_DRIVER_NODE_BODY_TELEMETRY_PUBLISHERS_H

#include <ros/node_handle.h>

#include <functional>
#include <string>
#include <vector>

#include "aibo_client/telemetry.h"
#include "movement/joint_table.h"
#include "movement/measured_joints.h"
#include "node/driver_parameters.h"
#include "node/robot_stamper.h"
#include "robot_model/robot_model.h"

namespace aibo_driver::node {

/// Publishes what the robot measures: joint_states, range/NAME, imu/data_raw, touch and battery. A sensor that the
/// robot does not have gets no topic. A message is published whenever there is something new in it, and made only if
/// somebody listens.
class TelemetryPublishers {
 public:
  /// All arguments except the handle must outlive the object.
  TelemetryPublishers(const ros::NodeHandle& handle, const DriverParameters& parameters,
                      const robot_model::RobotModel& model, const movement::JointTable& joint_table,
                      const movement::MeasuredJoints& measured_joints, RobotStamper& stamper);

  /// Call this when `measured_joints` has been updated. It never blocks. Only one thread at a time may call it.
  void publish(const aibo_client::Telemetry& telemetry);

 private:
  template <typename Source>
  void add(const std::string& topic, const std::string& frame, Source source);

  ros::NodeHandle handle_;
  const DriverParameters& parameters_;
  RobotStamper& stamper_;
  std::vector<std::function<void(const aibo_client::Telemetry&)>> publishers_;  ///< one for each topic
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_BODY_TELEMETRY_PUBLISHERS_H
