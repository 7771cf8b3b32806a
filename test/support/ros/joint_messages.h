/// @file joint_messages.h
#ifndef TEST_SUPPORT_ROS_JOINT_MESSAGES_H
#define TEST_SUPPORT_ROS_JOINT_MESSAGES_H

#include <sensor_msgs/JointState.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <map>
#include <string>

namespace test_support {

/// Positions of joints, in radians.
using Posture = std::map<std::string, double>;

/// A message for the topic joint_command.
inline sensor_msgs::JointState command(const Posture& posture) {
  sensor_msgs::JointState message;
  for (const auto& [joint, position] : posture) {
    message.name.push_back(joint);
    message.position.push_back(position);
  }
  return message;
}

/// A message for the topic joint_trajectory with one point.
inline trajectory_msgs::JointTrajectory trajectory(const Posture& posture, double seconds) {
  trajectory_msgs::JointTrajectory message;
  message.points.resize(1);
  message.points[0].time_from_start = ros::Duration(seconds);
  for (const auto& [joint, position] : posture) {
    message.joint_names.push_back(joint);
    message.points[0].positions.push_back(position);
  }
  return message;
}

}  // namespace test_support

#endif  // TEST_SUPPORT_ROS_JOINT_MESSAGES_H
