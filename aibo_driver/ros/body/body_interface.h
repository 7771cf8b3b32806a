/// @file body_interface.h
#ifndef AIBO_DRIVER_ROS_BODY_BODY_INTERFACE_H
#define AIBO_DRIVER_ROS_BODY_BODY_INTERFACE_H

#include <ros/node_handle.h>

#include "aibo_driver/rcserver_client.h"
#include "robot_model/robot_model.h"
#include "ros/body/expression_commander.h"
#include "ros/body/motion_file_services.h"
#include "ros/body/power_services.h"
#include "ros/body/sensor_publishers.h"
#include "ros/callback_thread.h"
#include "ros/telemetry_stamper.h"

namespace aibo_driver::node {

/// All that the driver has to do with the robot's body except its joints: sensors, LEDs, ears, the motions on its
/// memory stick, and its power. Commands and services are served by one thread of their own, so that a service that
/// waits for the memory stick keeps neither pictures nor joints waiting.
class BodyInterface {
 public:
  /// @param model, client must outlive the object
  BodyInterface(const ros::NodeHandle& handle, const robot_model::RobotModel& model, RcServerClient& client,
                TelemetryStamper stamp_of);

  /// A service that waits must have been ended before, by stopping the client.
  ~BodyInterface();

  BodyInterface(const BodyInterface&) = delete;
  BodyInterface& operator=(const BodyInterface&) = delete;

  /// Never blocks. From the client's thread.
  void publishTelemetry(const Telemetry& telemetry) { sensors_.publish(telemetry); }

 private:
  SensorPublishers sensors_;
  CallbackThread thread_;
  ExpressionCommander expression_;
  MotionFileServices motion_files_;
  PowerServices power_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_BODY_BODY_INTERFACE_H
