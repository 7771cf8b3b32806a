/// @file image_decoder.h
#ifndef AIBO_DRIVER_NODE_CAMERA_IMAGE_DECODER_H
#define AIBO_DRIVER_NODE_CAMERA_IMAGE_DECODER_H

#include <ros/node_handle.h>
#include <sensor_msgs/CompressedImage.h>

#include <memory>
#include <mutex>

#include "node/camera/raw_image_publisher.h"

namespace aibo_driver::node {

/// Decodes image_raw/compressed to image_raw, for bags that hold only the robot's JPEGs. It keeps the headers. It
/// subscribes only while image_raw has a subscriber.
class ImageDecoder {
 public:
  /// @param handle the camera's namespace; the root namespace means /aibo/camera
  explicit ImageDecoder(const ros::NodeHandle& handle);
  ~ImageDecoder();

  ImageDecoder(const ImageDecoder&) = delete;
  ImageDecoder& operator=(const ImageDecoder&) = delete;

 private:
  void updateSubscription();

  ros::NodeHandle handle_;
  std::mutex mutex_;  ///< callbacks may come before the constructor returns and while the destructor runs
  bool stopping_ = false;
  ros::Subscriber subscriber_;
  std::unique_ptr<RawImagePublisher> raw_images_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_CAMERA_IMAGE_DECODER_H
