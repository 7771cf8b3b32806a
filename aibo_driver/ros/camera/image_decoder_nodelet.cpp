#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

#include "ros/camera/image_decoder.h"

namespace aibo_driver::node {

/// The decoder inside of a nodelet manager.
class ImageDecoderNodelet : public nodelet::Nodelet {
 private:
  void onInit() override { decoder_ = std::make_unique<ImageDecoder>(getNodeHandle()); }

  std::unique_ptr<ImageDecoder> decoder_;
};

}  // namespace aibo_driver::node

PLUGINLIB_EXPORT_CLASS(aibo_driver::node::ImageDecoderNodelet, nodelet::Nodelet)
