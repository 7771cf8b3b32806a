/// @file trajectory_start.h
#ifndef AIBO_DRIVER_ROS_JOINTS_TRAJECTORY_START_H
#define AIBO_DRIVER_ROS_JOINTS_TRAJECTORY_START_H

#include <ros/time.h>

#include <chrono>

namespace aibo_driver::node {

/// How long to wait before a trajectory begins. From any thread.
/// @param stamp header.stamp of the message, whatever is in it; 0 means at once
/// @param now by the same clock
/// @return 0 to an hour; 0 also for a stamp of up to 1 s ago
/// @throw InvalidArgumentException the stamp is more than 1 s ago, or more than an hour ahead
std::chrono::nanoseconds waitBeforeStart(const ros::Time& stamp, const ros::Time& now);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_JOINTS_TRAJECTORY_START_H
