#include "support/ros/joint_messages.h"

namespace test_support {

sensor_msgs::JointState command(const Posture& posture) {
  sensor_msgs::JointState message;
  for (const auto& [joint, position] : posture) {
    message.name.push_back(joint);
    message.position.push_back(position);
  }
  return message;
}

trajectory_msgs::JointTrajectory trajectory(const Posture& posture, double seconds) {
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
