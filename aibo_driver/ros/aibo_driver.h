/// @file aibo_driver.h
#ifndef AIBO_DRIVER_ROS_AIBO_DRIVER_H
#define AIBO_DRIVER_ROS_AIBO_DRIVER_H

#include <ros/node_handle.h>

#include <string>

#include "aibo_driver/rcserver_client.h"
#include "robot_model/robot_model.h"
#include "robot_time/robot_clock.h"
#include "ros/body/body_interface.h"
#include "ros/body/power_status.h"
#include "ros/camera/camera_publisher.h"
#include "ros/camera/raw_image_publisher.h"
#include "ros/camera/stream_meter.h"
#include "ros/camera/stream_policy.h"
#include "ros/camera/stream_services.h"
#include "ros/connection_publisher.h"
#include "ros/driver_diagnostics.h"
#include "ros/driver_parameters.h"
#include "ros/joints/joint_interface.h"
#include "ros/live_settings.h"
#include "ros/robot_stamper.h"

namespace aibo_driver::node {

/// The whole driver: what node and nodelet wrap. docs/ros_interface.md tells what it looks like from outside.
class AiboDriver {
 public:
  /// Begins to connect and to publish. A robot that is not there is no error: the driver goes on trying.
  /// @param handle the driver's namespace; the root namespace means /aibo
  /// @param private_handle where the parameters are
  /// @param name of the node or nodelet, with its namespace, for the diagnostics
  /// @throw InvalidArgumentException a parameter is wrong; the message names it and what is allowed
  AiboDriver(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle, const std::string& name);

  /// Ends within a second.
  ~AiboDriver();

  AiboDriver(const AiboDriver&) = delete;
  AiboDriver& operator=(const AiboDriver&) = delete;

 private:
  RcServerClient::Callbacks makeCallbacks();
  LiveSettings::Targets settingTargets();
  void publishPicture(const Picture& picture);
  void publishTelemetry(const Telemetry& telemetry);
  void updateConnection(const ConnectionStatus& status);
  bool cameraHasSubscribers() const;

  /// Null if its time is not to be used.
  robot_time::RobotClock* usedRobotClock() { return parameters_.use_robot_time ? &robot_clock_ : nullptr; }

  // In the order in which they need each other. Callbacks of ROS may come as soon as a topic is advertised; until
  // policy_ is started, and once it is stopped, it does nothing about them.
  const DriverParameters parameters_;
  const robot_model::RobotModel& model_;
  ros::NodeHandle handle_;
  robot_time::RobotClock robot_clock_;
  RobotStamper telemetry_stamper_;
  PowerStatus power_;
  StreamMeter meter_;
  StreamPolicy policy_;
  ConnectionPublisher connection_;
  CameraPublisher camera_;
  RawImagePublisher raw_images_;
  RcServerClient client_;
  StreamServices services_;
  JointInterface joints_;
  BodyInterface body_;
  LiveSettings settings_;
  DriverDiagnostics diagnostics_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_AIBO_DRIVER_H
