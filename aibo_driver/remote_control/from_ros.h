/// @file from_ros.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_FROM_ROS_H
#define AIBO_DRIVER_REMOTE_CONTROL_FROM_ROS_H

#include <QString>
#include <string>

#include "text/plain_text.h"

namespace aibo_driver::remote_control {

/// Shortens the text of a message for display. Any node may have sent it, and laying out a megabyte would block the
/// window and its button STOP.
inline QString fromRos(const std::string& text) {
  constexpr std::size_t kLongest = 1000;
  return QString::fromStdString(text::plainLine(text, kLongest));
}

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_FROM_ROS_H
