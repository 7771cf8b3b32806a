/// @file connection_publisher.h
#ifndef AIBO_DRIVER_ROS_CONNECTION_PUBLISHER_H
#define AIBO_DRIVER_ROS_CONNECTION_PUBLISHER_H

#include <ros/node_handle.h>

#include <string>

#include "aibo_driver/rcserver_client.h"

namespace aibo_driver::node {

/// The robot's address as people write it: host:port.
std::string robotAddress(const ClientOptions& options);

/// Where the driver stands with the robot, in one line for people: what is the case, why, and what to check.
std::string describeConnection(const ConnectionStatus& status, const ClientOptions& options);

/// Publishes the latched topic `connection`.
class ConnectionPublisher {
 public:
  /// Publishes at once that there is no connection yet.
  ConnectionPublisher(const ros::NodeHandle& handle, const ClientOptions& options);

  /// Never blocks. From one thread at a time.
  void publish(const ConnectionStatus& status);

 private:
  const ClientOptions options_;
  ros::Publisher publisher_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_CONNECTION_PUBLISHER_H
