/// @file only_driver.h
#ifndef AIBO_DRIVER_NODE_ONLY_DRIVER_H
#define AIBO_DRIVER_NODE_ONLY_DRIVER_H

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <string>
#include <vector>

namespace aibo_driver::node {

/// The nodes that registered as publishers of a topic before a node, in the order in which they registered.
/// @param system_state the master's answer to getSystemState
std::vector<std::string> publishersBefore(const std::string& node, const std::string& topic,
                                          XmlRpc::XmlRpcValue system_state);

/// Ensures that a namespace has only one driver. A second driver would double every topic and take over the services.
/// When the second driver ended, the services would end with it.
///
/// This class registers as a publisher of `connection` before the driver does anything else. The master lists the
/// publishers in the order in which they came. So if two drivers start at the same time, one finds the other.
class OnlyDriver {
 public:
  /// Asks the ROS master and the nodes that were there before, for up to 2 s each. A node that was killed does not
  /// count, even if the master still knows it.
  /// @param handle a handle in the driver's namespace
  /// @throw std::runtime_error another driver has this namespace; the message names its node and says what to do
  explicit OnlyDriver(const ros::NodeHandle& handle);

 private:
  ros::Publisher claim_;  ///< registers the driver; nothing is ever published with it
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_ONLY_DRIVER_H
