/// @file joint_telemetry_publisher.h
#ifndef AIBO_DRIVER_ROS_JOINTS_JOINT_TELEMETRY_PUBLISHER_H
#define AIBO_DRIVER_ROS_JOINTS_JOINT_TELEMETRY_PUBLISHER_H

#include <ros/node_handle.h>

#include "aibo_driver/telemetry.h"
#include "joints/joint_table.h"
#include "joints/measured_joints.h"
#include "ros/telemetry_stamper.h"

namespace aibo_driver::node {

/// Publishes joint_states: where each telemetry found the joints, and how fast they move.
class JointTelemetryPublisher {
 public:
  /// @param table, measured must outlive the publisher
  JointTelemetryPublisher(const ros::NodeHandle& handle, const joints::JointTable& table,
                          joints::MeasuredJoints& measured, TelemetryStamper stamp_of);

  /// Never blocks. From one thread at a time.
  void publish(const Telemetry& telemetry);

 private:
  const joints::JointTable& table_;
  joints::MeasuredJoints& measured_;
  const TelemetryStamper stamp_of_;
  ros::Publisher publisher_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_JOINTS_JOINT_TELEMETRY_PUBLISHER_H
