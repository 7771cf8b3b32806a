/// @file joint_interface.h
#ifndef AIBO_DRIVER_ROS_JOINTS_JOINT_INTERFACE_H
#define AIBO_DRIVER_ROS_JOINTS_JOINT_INTERFACE_H

#include <ros/node_handle.h>

#include "aibo_driver/rcserver_client.h"
#include "joints/joint_link.h"
#include "joints/joint_table.h"
#include "joints/measured_joints.h"
#include "ros/body/motor_service.h"
#include "ros/body/play_motion_service.h"
#include "ros/callback_thread.h"
#include "ros/driver_parameters.h"
#include "ros/joints/joint_commander.h"
#include "ros/joints/joint_telemetry_publisher.h"
#include "ros/joints/trajectory_executor.h"
#include "ros/telemetry_stamper.h"

namespace aibo_driver::node {

/// All that the driver has to do with joints. Commands, trajectories and the services motors and play_motion are served
/// by one thread of their own: they never wait for a picture, and none of them overtakes another.
class JointInterface {
 public:
  /// @param client must outlive the object
  JointInterface(const ros::NodeHandle& handle, const DriverParameters& parameters, RcServerClient& client,
                 TelemetryStamper stamp_of);

  ~JointInterface();

  JointInterface(const JointInterface&) = delete;
  JointInterface& operator=(const JointInterface&) = delete;

  /// Never blocks. From the client's thread.
  void publishTelemetry(const Telemetry& telemetry) { telemetry_publisher_.publish(telemetry); }

  /// How fast joints may move, as a part of their speed limits, from the next command on. From any thread.
  /// @param scale above 0, at most 1
  void setSpeedScale(double scale) { table_.setSpeedScale(scale); }

  /// From the client's thread.
  void updateConnection(const ConnectionStatus& status);

 private:
  joints::JointTable table_;
  joints::MeasuredJoints measured_;
  JointTelemetryPublisher telemetry_publisher_;
  joints::JointLink link_;
  CallbackThread thread_;
  TrajectoryExecutor trajectories_;
  JointCommander commander_;
  MotorService motors_;
  PlayMotionService motions_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_JOINTS_JOINT_INTERFACE_H
