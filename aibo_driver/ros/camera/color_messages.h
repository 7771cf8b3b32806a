/// @file color_messages.h
/// What was detected in an image, as messages.
#ifndef AIBO_DRIVER_ROS_CAMERA_COLOR_MESSAGES_H
#define AIBO_DRIVER_ROS_CAMERA_COLOR_MESSAGES_H

#include <aibo_driver/ColorRegions.h>
#include <sensor_msgs/Image.h>
#include <std_msgs/Header.h>

#include <array>

#include "aibo_driver/colors.h"
#include "ros/camera/color_table_file.h"

namespace aibo_driver::node {

/// The regions in pixels of the camera's picture, which is twice as wide and high as the plane.
ColorRegions toRegions(const DetectedColors& colors, const std_msgs::Header& header);

/// By channel.
using ChannelColors = std::array<RgbColor, kMostColorChannels>;

/// The mask as an rgb8 image of the plane's size: black where nothing was detected, elsewhere the colour of the lowest
/// channel.
sensor_msgs::Image toMask(const DetectedColors& colors, const ChannelColors& channels, const std_msgs::Header& header);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_CAMERA_COLOR_MESSAGES_H
