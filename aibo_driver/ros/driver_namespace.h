/// @file driver_namespace.h
#ifndef AIBO_DRIVER_ROS_DRIVER_NAMESPACE_H
#define AIBO_DRIVER_ROS_DRIVER_NAMESPACE_H

#include <ros/node_handle.h>

#include <string>

namespace aibo_driver::node {

/// Where a node finds its topics and services. Nodes that are started bare, by rosrun in the root namespace, meet under
/// the same names as when they are launched; the log says so.
/// @param handle the namespace that the node was started in
/// @param default_namespace used instead of the root namespace, such as "aibo"
ros::NodeHandle inDriverNamespace(const ros::NodeHandle& handle, const std::string& default_namespace);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_DRIVER_NAMESPACE_H
