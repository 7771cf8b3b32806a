#include <ros/init.h>

#include <memory>

#include "node/camera/image_decoder.h"
#include "node/node.h"

int main(int argc, char** argv) {
  aibo_driver::node::init(argc, argv, "aibo_image_decoder");
  return aibo_driver::node::runNode(
      "decoder", [] { return std::make_shared<aibo_driver::node::ImageDecoder>(ros::NodeHandle()); });
}
