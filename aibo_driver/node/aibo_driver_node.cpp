#include <ros/init.h>
#include <ros/this_node.h>

#include <memory>

#include "node/aibo_driver.h"
#include "node/node.h"

int main(int argc, char** argv) {
  aibo_driver::node::init(argc, argv, "aibo_driver");
  return aibo_driver::node::runNode("driver", [] {
    return std::make_shared<aibo_driver::node::AiboDriver>(ros::NodeHandle(), ros::NodeHandle("~"),
                                                           ros::this_node::getName());
  });
}
