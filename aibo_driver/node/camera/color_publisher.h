/// @file color_publisher.h
#ifndef AIBO_DRIVER_NODE_CAMERA_COLOR_PUBLISHER_H
#define AIBO_DRIVER_NODE_CAMERA_COLOR_PUBLISHER_H

#include <aibo_driver/ColorRegions.h>
#include <ros/node_handle.h>
#include <sensor_msgs/Image.h>
#include <std_msgs/Header.h>

#include <array>
#include <functional>
#include <mutex>

#include "aibo_client/colors.h"
#include "camera/color_table_file.h"
#include "node/driver_parameters.h"
#include "node/robot_stamper.h"

namespace aibo_driver::node {

/// The regions in pixels of the camera's picture, which is twice as wide and high as the plane.
ColorRegions toRegions(const aibo_client::DetectedColors& colors, const std_msgs::Header& header);

/// The colour of each channel; the index is the channel.
using ChannelColors = std::array<camera::RgbColor, aibo_client::kMostColorChannels>;

/// The mask as an rgb8 image of the plane's size. A pixel where nothing was detected is black. Any other pixel has the
/// colour of its lowest channel.
sensor_msgs::Image toMask(const aibo_client::DetectedColors& colors, const ChannelColors& channels,
                          const std_msgs::Header& header);

/// Publishes what the robot's camera detects: color_regions, and color_mask as an image. The robot detects only while
/// one of the two has a subscriber. It sends the mask only while color_mask has one. Any thread may call any function.
class ColorPublisher {
 public:
  /// @param handle the driver's namespace
  /// @param robot_clock must outlive the publisher; if it is null, the stamp of a message is its time of arrival
  /// @param detect called from the handle's callback queue with what the robot should send, whenever a subscriber comes
  ///   or goes; must not block
  ColorPublisher(const ros::NodeHandle& handle, const DriverParameters& parameters, robot_time::RobotClock* robot_clock,
                 const std::function<void(const aibo_client::ColorDetection&)>& detect);

  /// Call this when a channel has another table. The channel's pixels in color_mask then get the table's colour.
  /// @param table null if the channel has none
  void setTable(int channel, const aibo_client::ColorTablePtr& table);

  /// Publishes the colours of an image. It never blocks.
  void publish(const aibo_client::DetectedColors& colors);

 private:
  const std::string frame_id_;
  RobotStamper stamper_;
  std::mutex mutex_;
  ChannelColors channel_colors_;  ///< guarded by mutex_
  ros::Publisher regions_;
  ros::Publisher mask_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_CAMERA_COLOR_PUBLISHER_H
