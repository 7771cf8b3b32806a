/// @file only_driver.h
#ifndef AIBO_DRIVER_ROS_ONLY_DRIVER_H
#define AIBO_DRIVER_ROS_ONLY_DRIVER_H

#include <ros/node_handle.h>
#include <ros/publisher.h>

namespace aibo_driver::node {

/// Sees to it that a namespace has one driver. A second one would double every topic, take over the services, and take
/// them with it when it ends.
///
/// It registers as a publisher of `connection` before the driver does anything else. The master's list has the
/// publishers in the order in which they came, so of two drivers that start at the same time one finds the other.
class OnlyDriver {
 public:
  /// Asks the ROS master, and the nodes that were there before, for up to 2 s each. A node that was killed, which the
  /// master still knows, does not count.
  /// @param handle in the driver's namespace
  /// @throw std::runtime_error another driver has this namespace; the message names its node and says what to do
  explicit OnlyDriver(const ros::NodeHandle& handle);

 private:
  ros::Publisher claim_;  ///< never published to
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_ONLY_DRIVER_H
