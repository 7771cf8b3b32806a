#include "node/camera/image_decoder.h"

#include <ros/console.h>
#include <ros/transport_hints.h>

#include "node/node.h"

namespace aibo_driver::node {

ImageDecoder::ImageDecoder(const ros::NodeHandle& handle) : handle_(inDriverNamespace(handle, "aibo/camera")) {
  const std::lock_guard<std::mutex> lock(mutex_);
  raw_images_ = std::make_unique<RawImagePublisher>(handle_, "image_raw", [this] { updateSubscription(); });
  const std::string topic = handle_.resolveName("image_raw");
  ROS_INFO_STREAM("Decoding " << topic << "/compressed to " << topic << " while it has subscribers.");
}

// After the shutdown, neither side calls the other, although subscribers may still come and go on another thread.
ImageDecoder::~ImageDecoder() {
  const std::lock_guard<std::mutex> lock(mutex_);
  stopping_ = true;
  subscriber_.shutdown();
}

void ImageDecoder::updateSubscription() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (stopping_) {
    return;
  }
  if (!raw_images_->hasSubscribers()) {
    subscriber_.shutdown();
  } else if (!subscriber_) {
    const boost::function<void(const sensor_msgs::CompressedImageConstPtr&)> on_picture =
        [this](const sensor_msgs::CompressedImageConstPtr& picture) { raw_images_->publish(picture); };
    subscriber_ =
        handle_.subscribe<sensor_msgs::CompressedImage>(handle_.resolveName("image_raw") + "/compressed", 1, on_picture,
                                                        ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  }
}

}  // namespace aibo_driver::node
