/// @file trajectory_messages.h
#ifndef AIBO_DRIVER_NODE_JOINTS_TRAJECTORY_MESSAGES_H
#define AIBO_DRIVER_NODE_JOINTS_TRAJECTORY_MESSAGES_H

#include <ros/time.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <chrono>

#include "movement/trajectory.h"

namespace aibo_driver::node {

/// How long to wait before a trajectory begins. Any thread may call this function.
/// @param stamp header.stamp of the message, with any value; 0 means at once
/// @param now the time of the same clock
/// @return -1 s to one hour; it is below 0 if the trajectory should have begun already
/// @throw InvalidArgumentException the stamp is more than 1 s in the past, or more than an hour in the future
std::chrono::nanoseconds waitBeforeStart(const ros::Time& stamp, const ros::Time& now);

/// Makes a request of the message, without its stamp and without a check. Any thread may call this function.
movement::TrajectoryRequest toRequest(const trajectory_msgs::JointTrajectory& message);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_JOINTS_TRAJECTORY_MESSAGES_H
