/// @file trajectory_messages.h
#ifndef AIBO_DRIVER_ROS_JOINTS_TRAJECTORY_MESSAGES_H
#define AIBO_DRIVER_ROS_JOINTS_TRAJECTORY_MESSAGES_H

#include <ros/time.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <chrono>

#include "movement/trajectory.h"

namespace aibo_driver::node {

/// How long to wait before a trajectory begins. From any thread.
/// @param stamp header.stamp of the message, whatever it contains; 0 means at once
/// @param now by the same clock
/// @return -1 s to an hour; below 0 if it should have begun before
/// @throw InvalidArgumentException the stamp is more than 1 s ago, or more than an hour ahead
std::chrono::nanoseconds waitBeforeStart(const ros::Time& stamp, const ros::Time& now);

/// The same trajectory without its stamp, unchecked. From any thread.
movement::TrajectoryRequest toRequest(const trajectory_msgs::JointTrajectory& message);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_JOINTS_TRAJECTORY_MESSAGES_H
