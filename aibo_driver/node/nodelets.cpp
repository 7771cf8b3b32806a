#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <exception>
#include <memory>

#include "node/aibo_driver.h"
#include "node/camera/image_decoder.h"

namespace aibo_driver::node {

/// The driver in a nodelet manager, whose nodelets exchange messages without copying them.
class AiboDriverNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      driver_ = std::make_unique<AiboDriver>(getNodeHandle(), getPrivateNodeHandle(), getName());
    } catch (const std::exception& error) {
      NODELET_FATAL_STREAM("The driver cannot start. " << error.what());
      throw;  // the manager answers that it could not load the nodelet
    }
  }

  std::unique_ptr<AiboDriver> driver_;
};

/// The decoder in a nodelet manager.
class ImageDecoderNodelet : public nodelet::Nodelet {
 private:
  void onInit() override { decoder_ = std::make_unique<ImageDecoder>(getNodeHandle()); }

  std::unique_ptr<ImageDecoder> decoder_;
};

}  // namespace aibo_driver::node

PLUGINLIB_EXPORT_CLASS(aibo_driver::node::AiboDriverNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(aibo_driver::node::ImageDecoderNodelet, nodelet::Nodelet)
