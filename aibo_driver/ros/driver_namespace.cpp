#include "ros/driver_namespace.h"

#include <ros/console.h>

namespace aibo_driver::node {

ros::NodeHandle inDriverNamespace(const ros::NodeHandle& handle, const std::string& default_namespace) {
  if (handle.getNamespace() != "/") {
    return handle;
  }
  ROS_INFO_STREAM("Started in the root namespace: topics and services are under /" << default_namespace << ".");
  return {handle, default_namespace};
}

}  // namespace aibo_driver::node
