#include <ros/init.h>

#include <memory>

#include "ros/camera/image_decoder.h"
#include "ros/node.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "aibo_image_decoder");
  return aibo_driver::node::runNode(
      "decoder", [] { return std::make_shared<aibo_driver::node::ImageDecoder>(ros::NodeHandle()); });
}
