/// @file telemetry_stamper.h
#ifndef AIBO_DRIVER_ROS_TELEMETRY_STAMPER_H
#define AIBO_DRIVER_ROS_TELEMETRY_STAMPER_H

#include <ros/time.h>

#include <functional>

#include "aibo_driver/telemetry.h"

namespace aibo_driver::node {

/// When a telemetry was measured, on ROS' clock: the stamp of all messages that are made of it. Asked for the same
/// telemetry again, it answers the same. From the client's thread.
using TelemetryStamper = std::function<ros::Time(const Telemetry& telemetry)>;

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_TELEMETRY_STAMPER_H
