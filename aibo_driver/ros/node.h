/// @file node.h
/// What the programs of this package need as ROS nodes.
#ifndef AIBO_DRIVER_ROS_NODE_H
#define AIBO_DRIVER_ROS_NODE_H

#include <ros/node_handle.h>

#include <functional>
#include <memory>
#include <string>

namespace aibo_driver::node {

/// Where a node finds its topics and services. Nodes that are started bare, by rosrun in the root namespace, use the
/// same names as when they are launched; the log says so.
/// @param handle the namespace that the node was started in
/// @param default_namespace used instead of the root namespace, such as "aibo"
ros::NodeHandle inDriverNamespace(const ros::NodeHandle& handle, const std::string& default_namespace);

/// Runs a node until it is shut down: serves the global callback queue, and registers it again with a restarted ROS
/// master (MasterWatch).
///
/// On Ctrl-C (SIGINT) it ends as roscpp does, but not later than 10 s: roscpp unregisters each topic and service with
/// the ROS master and waits for its answers without limit. If that takes longer, the process says so on stderr and ends
/// at once, with EXIT_FAILURE. A second Ctrl-C ends it at once in any case.
///
/// To be called once, from main(), after ros::init(). Takes SIGALRM.
/// @param name for the log: completes "The ... cannot start."
/// @param make makes what the node consists of, which lives until the node ends
/// @return the exit status; EXIT_FAILURE if `make` throws
int runNode(const std::string& name, const std::function<std::shared_ptr<void>()>& make);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_NODE_H
