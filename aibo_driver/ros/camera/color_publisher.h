/// @file color_publisher.h
#ifndef AIBO_DRIVER_ROS_CAMERA_COLOR_PUBLISHER_H
#define AIBO_DRIVER_ROS_CAMERA_COLOR_PUBLISHER_H

#include <ros/node_handle.h>

#include <functional>
#include <mutex>

#include "aibo_driver/colors.h"
#include "ros/camera/color_messages.h"
#include "ros/driver_parameters.h"
#include "ros/robot_stamper.h"

namespace aibo_driver::node {

/// Publishes what the robot's camera detects: color_regions, and color_mask as an image. The robot detects only while
/// one of them has a subscriber, and sends the mask only while color_mask has one. Every function may be called from
/// any thread.
class ColorPublisher {
 public:
  /// @param handle the driver's namespace
  /// @param robot_clock must outlive the publisher; null: messages are stamped with their arrival
  ColorPublisher(const ros::NodeHandle& handle, const DriverParameters& parameters,
                 robot_time::RobotClock* robot_clock);

  /// Hands on what the robot is to send, now and whenever a subscriber comes or goes.
  /// @param detect must not block
  void start(std::function<void(const ColorDetection&)> detect);

  /// When it has returned, `detect` is not running and will not be called any more.
  void stop();

  /// A channel has another table: its pixels in color_mask get the table's colour.
  /// @param table null: the channel has none
  void setTable(int channel, const ColorTablePtr& table);

  /// Never blocks.
  void publish(const DetectedColors& colors);

 private:
  void subscribersChanged();

  const std::string frame_id_;
  const int every_nth_image_;
  RobotStamper stamper_;
  std::mutex mutex_;
  std::function<void(const ColorDetection&)> detect_;  ///< empty unless started
  ChannelColors channel_colors_;
  ros::Publisher regions_;
  ros::Publisher mask_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_CAMERA_COLOR_PUBLISHER_H
