/// @file page_texts.h
/// What the pages are told, each text as JSON with its type.
#ifndef AIBO_DRIVER_WEB_PAGE_TEXTS_H
#define AIBO_DRIVER_WEB_PAGE_TEXTS_H

#include <aibo_driver/Connection.h>
#include <aibo_driver/LinkQuality.h>
#include <aibo_driver/ListMotions.h>
#include <aibo_driver/MotionState.h>
#include <aibo_driver/RobotState.h>
#include <sensor_msgs/BatteryState.h>

#include <string>

namespace aibo_driver::web {

/// @{ From the driver's messages. Any node may have sent them.
std::string pageText(const Connection& message);
std::string pageText(const RobotState& message);
std::string pageText(const MotionState& message);
std::string pageText(const sensor_msgs::BatteryState& message);
std::string pageText(const LinkQuality& message);
std::string pageText(const ListMotions::Response& response);
/// @}

/// Something in words, such as an answer.
std::string pageText(const std::string& type, const std::string& words);

}  // namespace aibo_driver::web

#endif  // AIBO_DRIVER_WEB_PAGE_TEXTS_H
