/// @file ros_log_sink.h
#ifndef AIBO_DRIVER_ROS_ROS_LOG_SINK_H
#define AIBO_DRIVER_ROS_ROS_LOG_SINK_H

#include "aibo_driver/log.h"

namespace aibo_driver::node {

/// Hands the client library's messages to rosconsole, as the logger ros.aibo_driver.client.
LogSink makeRosLogSink();

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_ROS_LOG_SINK_H
