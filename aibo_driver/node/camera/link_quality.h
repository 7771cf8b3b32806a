/// @file link_quality.h
#ifndef AIBO_DRIVER_NODE_CAMERA_LINK_QUALITY_H
#define AIBO_DRIVER_NODE_CAMERA_LINK_QUALITY_H

#include <aibo_driver/LinkQuality.h>
#include <ros/node_handle.h>
#include <ros/time.h>

#include <functional>
#include <optional>

#include "aibo_client/picture.h"
#include "node/camera/link_meter.h"

namespace aibo_driver::node {

/// The message without a stamp.
/// @param asked_rate the pictures a second that the robot is asked for now
LinkQuality toMessage(const LinkMeter::Reading& reading, double asked_rate);

/// Publishes the topic `link_quality` while it has a subscriber.
class LinkQualityPublisher {
 public:
  /// @param asked_every_nth_image the stream that the robot is asked for now; empty while the stream is off
  LinkQualityPublisher(const ros::NodeHandle& handle, std::function<std::optional<int>()> asked_every_nth_image);

  /// Call this for each published picture. It never blocks. Any thread may call it.
  /// @param stamp the stamp of the picture's message
  void add(const aibo_client::Picture& picture, const ros::Time& stamp);

  /// Publishes what was measured since the last call. Call this once a second, from only one thread at a time.
  void publish();

 private:
  const std::function<std::optional<int>()> asked_every_nth_image_;
  LinkMeter meter_{std::chrono::steady_clock::now()};
  ros::Publisher publisher_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_CAMERA_LINK_QUALITY_H
