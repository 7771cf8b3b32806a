/// @file joint_commander.h
#ifndef AIBO_DRIVER_ROS_JOINTS_JOINT_COMMANDER_H
#define AIBO_DRIVER_ROS_JOINTS_JOINT_COMMANDER_H

#include <ros/console.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>
#include <sensor_msgs/JointState.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "aibo_driver/rcserver_client.h"
#include "joints/joint_command_filter.h"
#include "joints/joint_link.h"
#include "joints/joint_table.h"
#include "joints/measured_joints.h"
#include "ros/driver_parameters.h"
#include "ros/joints/trajectory_executor.h"
#include "ros/throttled_warnings.h"

namespace aibo_driver::node {

/// Everything that commands joints: the topics joint_command, JOINT_position_controller/command and joint_trajectory.
///
/// A message of joint_command goes to the robot at once and as a whole, through the JointCommandFilter. A
/// position_controller topic belongs to one joint: what these topics bring within kCollectingTime is sent together. A
/// trajectory gives way to a command to one of its joints. Nothing is kept while there is no connection.
///
/// From one thread at a time.
class JointCommander {
 public:
  /// How long commands to single joints are collected: half of the 8 ms in which the robot takes new positions.
  static constexpr std::chrono::milliseconds kCollectingTime{4};

  /// @param table, measured, client must outlive the commander
  JointCommander(const joints::JointTable& table, const joints::MeasuredJoints& measured, RcServerClient& client,
                 const DriverParameters& parameters);

  JointCommander(const JointCommander&) = delete;
  JointCommander& operator=(const JointCommander&) = delete;

  /// @param handle whose callback queue one thread serves
  void subscribe(const ros::NodeHandle& handle);

  /// What was not sent is logged.
  void receive(const sensor_msgs::JointState& message);

  /// To be called before the motors are switched. Ends the trajectory. From now on the posture may be any, so all
  /// joints are approached again: see JointCommandFilter.
  void prepareForMotors();

  /// To be called before the robot plays a motion of its own. Ends the trajectory, and lets all joints move as fast as
  /// their limits allow: the robot would keep to lower limits of earlier commands.
  /// @throw as RcServerClient::setJointSpeedLimits()
  void prepareForMotion();

 private:
  void receivePosition(const std::string& name, double position);
  void collect(const std::vector<std::string>& names, const std::vector<double>& positions,
               const std::vector<double>& velocities);
  void send();

  const joints::JointTable& table_;
  joints::JointLink link_;
  joints::JointCommandFilter filter_;
  TrajectoryExecutor trajectories_;
  ThrottledWarnings warnings_{[](const std::string& text) { ROS_WARN_STREAM_NAMED("joints", text); }};
  std::uint64_t connection_ = 0;  ///< over which what waits may be sent
  joints::JointOrders waiting_;
  ros::SteadyTimer collecting_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_JOINTS_JOINT_COMMANDER_H
