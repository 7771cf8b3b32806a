#include <ros/init.h>

#include <memory>

#include "node/camera/image_decoder.h"
#include "node/node.h"
#include "tools/program.h"

namespace {

constexpr char kHelp[] = R"(  ROS_NAMESPACE=aibo/camera rosrun aibo_driver aibo_image_decoder

Decodes image_raw/compressed to image_raw, while somebody subscribes to it.
)";

}  // namespace

int main(int argc, char** argv) {
  aibo_driver::tools::init(argc, argv, "aibo_image_decoder", kHelp);
  return aibo_driver::node::runNode(
      "decoder", [] { return std::make_shared<aibo_driver::node::ImageDecoder>(ros::NodeHandle()); });
}
