#include <ros/ros.h>

#include <cstdlib>
#include <exception>

#include "image_decoder.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "aibo_image_decoder");
  try {
    const aibo_driver::ImageDecoder decoder{ros::NodeHandle()};
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM("The decoder cannot start. " << error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
