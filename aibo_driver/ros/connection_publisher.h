/// @file connection_publisher.h
#ifndef AIBO_DRIVER_ROS_CONNECTION_PUBLISHER_H
#define AIBO_DRIVER_ROS_CONNECTION_PUBLISHER_H

#include <aibo_driver/Connection.h>
#include <ros/node_handle.h>

#include <optional>
#include <string>

#include "aibo_driver/rcserver_client.h"

namespace aibo_driver::node {

/// The robot's address as host:port.
std::string robotAddress(const ClientOptions& options);

/// The state of the connection in one line for people: what it is, why, and what to check.
std::string describeConnection(const ConnectionStatus& status, const ClientOptions& options);

/// Publishes the latched topics `connection` and `streaming`.
class ConnectionPublisher {
 public:
  /// Publishes at once that there is no connection and no stream yet.
  ConnectionPublisher(const ros::NodeHandle& handle, const ClientOptions& options);

  /// Publishes nothing if the message would be the same as the last one. Never blocks. From one thread at a time.
  void publish(const ConnectionStatus& status);
  void publishStreaming(bool streaming);

 private:
  const ClientOptions options_;
  ros::Publisher connection_;
  ros::Publisher streaming_;
  std::optional<Connection> last_;  ///< published, without its stamp
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_CONNECTION_PUBLISHER_H
