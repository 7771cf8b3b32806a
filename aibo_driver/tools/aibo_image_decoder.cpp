#include <ros/ros.h>

#include <cstdlib>
#include <exception>

#include "ros/camera/image_decoder.h"
#include "ros/interrupt.h"
#include "ros/master_watch.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "aibo_image_decoder");
  // Outside of the try block: when the last handle goes, logging ends, and the reason below would not be seen.
  const ros::NodeHandle handle;
  aibo_driver::node::endOnInterrupt();
  try {
    const aibo_driver::node::ImageDecoder decoder(handle);
    const aibo_driver::node::MasterWatch master_watch(ros::this_node::getName());
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM("The decoder cannot start. " << error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
