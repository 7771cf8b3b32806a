#include <ros/init.h>
#include <ros/this_node.h>

#include <memory>

#include "ros/aibo_driver.h"
#include "ros/node.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "aibo_driver");
  return aibo_driver::node::runNode("driver", [] {
    return std::make_shared<aibo_driver::node::AiboDriver>(ros::NodeHandle(), ros::NodeHandle("~"),
                                                           ros::this_node::getName());
  });
}
