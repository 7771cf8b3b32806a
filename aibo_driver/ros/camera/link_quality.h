/// @file link_quality.h
#ifndef AIBO_DRIVER_ROS_CAMERA_LINK_QUALITY_H
#define AIBO_DRIVER_ROS_CAMERA_LINK_QUALITY_H

#include <aibo_driver/LinkQuality.h>
#include <ros/node_handle.h>
#include <ros/time.h>

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>

#include "aibo_driver/picture.h"

namespace aibo_driver::node {

/// Measures how well pictures come, between two readings. Every function may be called from any thread.
class LinkQualityMeter {
 public:
  /// To be called when a picture has been published.
  /// @param age s, from the picture's stamp until now
  /// @param every_nth_image of the camera that the robot is asked for; 1 or more
  void add(const Picture& picture, double age, int every_nth_image);

  /// What was measured since the last reading, without a stamp.
  /// @param seconds since then, above 0
  /// @param asked_rate pictures a second that the robot is asked for now
  LinkQuality read(double seconds, double asked_rate);

 private:
  std::uint64_t imagesDue(const Picture& picture, int every_nth_image);

  std::mutex mutex_;
  std::uint64_t pictures_ = 0;
  std::uint64_t bytes_ = 0;
  std::uint64_t aged_ = 0;  ///< pictures of which it is known when they were taken
  double age_sum_ = 0;
  double longest_age_ = 0;
  std::uint64_t counted_ = 0;  ///< pictures of which it is known how many were due
  std::uint64_t due_ = 0;      ///< of these, with those that did not come
  std::uint64_t connection_number_ = 0;
  std::optional<std::uint32_t> last_image_;  ///< number of the newest image of this connection
};

/// Publishes the topic `link_quality` while it has a subscriber.
class LinkQualityPublisher {
 public:
  /// @param asked_every_nth_image how the robot is asked to stream now; empty while the stream is off
  LinkQualityPublisher(const ros::NodeHandle& handle, std::function<std::optional<int>()> asked_every_nth_image);

  /// To be called for each published picture. Never blocks. From any thread.
  /// @param stamp of its message
  void add(const Picture& picture, const ros::Time& stamp);

  /// Publishes what was measured since the last call. To be called once a second, from one thread at a time.
  void publish();

 private:
  const std::function<std::optional<int>()> asked_every_nth_image_;
  LinkQualityMeter meter_;
  ros::SteadyTime last_publication_ = ros::SteadyTime::now();
  ros::Publisher publisher_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_CAMERA_LINK_QUALITY_H
