/// @file color_messages.h
/// Makes messages from the colours that were detected in an image.
#ifndef AIBO_DRIVER_NODE_CAMERA_COLOR_MESSAGES_H
#define AIBO_DRIVER_NODE_CAMERA_COLOR_MESSAGES_H

#include <aibo_driver/ColorRegions.h>
#include <sensor_msgs/Image.h>
#include <std_msgs/Header.h>

#include <array>

#include "aibo_client/colors.h"
#include "camera/color_table_file.h"

namespace aibo_driver::node {

/// The regions in pixels of the camera's picture, which is twice as wide and high as the plane.
ColorRegions toRegions(const aibo_client::DetectedColors& colors, const std_msgs::Header& header);

/// The colour of each channel; the index is the channel.
using ChannelColors = std::array<camera::RgbColor, aibo_client::kMostColorChannels>;

/// The mask as an rgb8 image of the plane's size. A pixel where nothing was detected is black. Any other pixel has the
/// colour of its lowest channel.
sensor_msgs::Image toMask(const aibo_client::DetectedColors& colors, const ChannelColors& channels,
                          const std_msgs::Header& header);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_CAMERA_COLOR_MESSAGES_H
