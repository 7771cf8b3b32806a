#include <ros/ros.h>

#include <cstdlib>
#include <exception>

#include "aibo_driver.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "aibo_driver");
  try {
    const aibo_driver::AiboDriver driver(ros::NodeHandle(), ros::NodeHandle("~"), ros::this_node::getName());
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM("The driver cannot start. " << error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
