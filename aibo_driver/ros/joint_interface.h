/// @file joint_interface.h
#ifndef AIBO_DRIVER_JOINT_INTERFACE_H
#define AIBO_DRIVER_JOINT_INTERFACE_H

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include "aibo_driver/rcserver_client.h"
#include "driver_parameters.h"
#include "joint_commander.h"
#include "joint_telemetry_publisher.h"
#include "motion/joint_link.h"
#include "motion/joint_table.h"
#include "motion/measured_joints.h"
#include "motor_service.h"
#include "trajectory_executor.h"

namespace aibo_driver {

/// All that the driver has to do with joints. Commands, trajectories and the motors service are served by one thread of
/// their own: they never wait for a picture, and none of them overtakes another.
class JointInterface {
 public:
  /// @param client must outlive the object
  JointInterface(const ros::NodeHandle& handle, const DriverParameters& parameters, RcServerClient& client);

  ~JointInterface();

  JointInterface(const JointInterface&) = delete;
  JointInterface& operator=(const JointInterface&) = delete;

  /// Never blocks. From the client's thread.
  void publishTelemetry(const Telemetry& telemetry) { telemetry_publisher_.publish(telemetry); }

  /// From the client's thread.
  void updateConnection(const ConnectionStatus& status);

 private:
  const JointTable table_;
  MeasuredJoints measured_;
  JointTelemetryPublisher telemetry_publisher_;
  JointLink link_;
  ros::CallbackQueue queue_;
  ros::NodeHandle handle_;
  TrajectoryExecutor trajectories_;
  JointCommander commander_;
  MotorService motors_;
  ros::AsyncSpinner thread_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_JOINT_INTERFACE_H
