/// @file trajectory_start.h
#ifndef AIBO_DRIVER_TRAJECTORY_START_H
#define AIBO_DRIVER_TRAJECTORY_START_H

#include <ros/time.h>

#include <chrono>

namespace aibo_driver {

/// How long to wait before a trajectory begins.
/// @param stamp header.stamp of the message, whatever is in it; 0 means at once
/// @throw InvalidArgumentException it was to begin long ago, or is to begin in a time that nobody means
std::chrono::nanoseconds waitBeforeStart(const ros::Time& stamp, const ros::Time& now);

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_TRAJECTORY_START_H
