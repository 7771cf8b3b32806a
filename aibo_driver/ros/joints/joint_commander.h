/// @file joint_commander.h
#ifndef AIBO_DRIVER_ROS_JOINTS_JOINT_COMMANDER_H
#define AIBO_DRIVER_ROS_JOINTS_JOINT_COMMANDER_H

#include <ros/console.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>
#include <sensor_msgs/JointState.h>

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "joints/joint_command_filter.h"
#include "joints/joint_link.h"
#include "joints/joint_table.h"
#include "joints/measured_joints.h"
#include "ros/throttled_warnings.h"

namespace aibo_driver::node {

/// Takes commands from joint_command and from the JOINT_position_controller/command topics, and sends what
/// JointCommandFilter leaves of them.
///
/// A message of joint_command goes to the robot at once and as a whole. The other topics hold one joint each: what they
/// bring within kCollectingTime is sent together.
///
/// Nothing is kept while there is no connection. Everything runs on the callback queue of the handle, which must be
/// served by one thread.
class JointCommander {
 public:
  /// How long commands to single joints are collected: half of the 8 ms in which the robot takes new positions.
  static constexpr std::chrono::milliseconds kCollectingTime{4};

  /// @param table, measured, link must outlive the commander
  /// @param approach_speed rad/s, see JointCommandFilter
  /// @param commanded called with what is going to be sent
  JointCommander(const ros::NodeHandle& handle, const joints::JointTable& table, const joints::MeasuredJoints& measured,
                 joints::JointLink& link, double approach_speed,
                 std::function<void(const std::vector<joints::JointOrder>&)> commanded);

  /// The posture may be any from now on: see JointCommandFilter. From the thread of the callback queue.
  void startApproach() { filter_.startApproach(); }

 private:
  void receiveJointState(const sensor_msgs::JointState& message);
  void receivePosition(const std::string& name, double position);
  void collect(const joints::JointCommand& command);
  void send();

  joints::JointLink& link_;
  const std::function<void(const std::vector<joints::JointOrder>&)> commanded_;
  joints::JointCommandFilter filter_;
  ThrottledWarnings warnings_{[](const std::string& text) { ROS_WARN_STREAM_NAMED("joints", text); }};
  std::uint64_t connection_ = 0;               ///< over which what follows is to be sent
  std::map<int, joints::JointOrder> waiting_;  ///< by id
  ros::SteadyTimer collecting_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_JOINTS_JOINT_COMMANDER_H
