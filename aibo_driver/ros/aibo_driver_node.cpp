#include <ros/ros.h>

#include <cstdlib>
#include <exception>

#include "ros/aibo_driver.h"
#include "ros/interrupt.h"
#include "ros/master_watch.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "aibo_driver");
  // Outside of the try block: when the last handle goes, logging ends, and the reason below would not be seen.
  const ros::NodeHandle handle;
  const ros::NodeHandle private_handle("~");
  aibo_driver::node::endOnInterrupt();
  try {
    const aibo_driver::node::AiboDriver driver(handle, private_handle, ros::this_node::getName());
    const aibo_driver::node::MasterWatch master_watch(ros::this_node::getName());
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM("The driver cannot start. " << error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
