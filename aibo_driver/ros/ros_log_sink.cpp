#include "ros/ros_log_sink.h"

#include <ros/console.h>

namespace aibo_driver::node {

LogSink makeRosLogSink() {
  return [](LogLevel level, const std::string& message) {
    switch (level) {
      case LogLevel::kDebug:
        ROS_DEBUG_STREAM_NAMED("client", message);
        break;
      case LogLevel::kInfo:
        ROS_INFO_STREAM_NAMED("client", message);
        break;
      case LogLevel::kWarn:
        ROS_WARN_STREAM_NAMED("client", message);
        break;
      case LogLevel::kError:
        ROS_ERROR_STREAM_NAMED("client", message);
        break;
    }
  };
}

}  // namespace aibo_driver::node
