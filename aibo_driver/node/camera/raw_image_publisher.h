/// @file raw_image_publisher.h
#ifndef AIBO_DRIVER_NODE_CAMERA_RAW_IMAGE_PUBLISHER_H
#define AIBO_DRIVER_NODE_CAMERA_RAW_IMAGE_PUBLISHER_H

#include <image_transport/image_transport.h>
#include <ros/node_handle.h>
#include <sensor_msgs/CompressedImage.h>

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "camera/jpeg_decoder.h"

namespace aibo_driver::node {

/// Publishes JPEG pictures as bgr8 images through image_transport while they have subscribers.
///
/// The publisher decodes in a thread of its own, so that publish() never waits. One picture can wait while another is
/// being decoded. A newer picture takes the place of the one that waits.
///
/// If compressed_image_transport is installed, it advertises TOPIC/compressed for every image topic. It would then be a
/// second publisher on the topic of the robot's own JPEGs, so its plugins are disabled for this topic.
class RawImagePublisher {
 public:
  struct Statistics {
    std::uint64_t published = 0;      ///< images that were decoded and published
    std::uint64_t decode_errors = 0;  ///< pictures that could not be decoded
    std::uint64_t skipped = 0;        ///< pictures replaced by a newer one before they were decoded
  };

  /// @param handle the handle whose namespace the topic is in
  /// @param topic the base name of the image topic, such as image_raw; it may be remapped
  /// @param subscribers_changed called from handle's callback queue when a subscriber comes or goes; may be empty
  RawImagePublisher(const ros::NodeHandle& handle, const std::string& topic, std::function<void()> subscribers_changed);
  ~RawImagePublisher();

  RawImagePublisher(const RawImagePublisher&) = delete;
  RawImagePublisher& operator=(const RawImagePublisher&) = delete;

  /// Hands a picture to the decoder, without blocking. Call it only while hasSubscribers(). Any thread may call it.
  void publish(const sensor_msgs::CompressedImageConstPtr& picture);

  bool hasSubscribers() const;

  Statistics statistics() const;

 private:
  void run();
  void decodeAndPublish(const sensor_msgs::CompressedImage& picture);

  image_transport::Publisher publisher_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool stopping_ = false;
  sensor_msgs::CompressedImageConstPtr waiting_;  ///< the next picture to be decoded
  Statistics statistics_;

  std::thread thread_;  // last, because it uses all members above
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_CAMERA_RAW_IMAGE_PUBLISHER_H
