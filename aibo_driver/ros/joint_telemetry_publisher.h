/// @file joint_telemetry_publisher.h
#ifndef AIBO_DRIVER_JOINT_TELEMETRY_PUBLISHER_H
#define AIBO_DRIVER_JOINT_TELEMETRY_PUBLISHER_H

#include <ros/node_handle.h>

#include <chrono>

#include "aibo_driver/telemetry.h"
#include "motion/joint_table.h"
#include "motion/measured_joints.h"
#include "picture_stamper.h"

namespace aibo_driver {

/// Publishes joint_states: where each telemetry found the joints, and how fast they move. Stamped as pictures are.
class JointTelemetryPublisher {
 public:
  /// @param table, measured must outlive the publisher
  JointTelemetryPublisher(const ros::NodeHandle& handle, const JointTable& table, MeasuredJoints& measured,
                          std::chrono::nanoseconds time_offset);

  /// Never blocks. From one thread at a time.
  void publish(const Telemetry& telemetry);

 private:
  const JointTable& table_;
  MeasuredJoints& measured_;
  PictureStamper stamper_;
  ros::Publisher publisher_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_JOINT_TELEMETRY_PUBLISHER_H
