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

/// For the topic joint_command.
sensor_msgs::JointState command(const Posture& posture);

/// For the topic joint_trajectory: straight to there.
trajectory_msgs::JointTrajectory trajectory(const Posture& posture, double seconds);

}  // namespace test_support

#endif  // TEST_SUPPORT_ROS_JOINT_MESSAGES_H
