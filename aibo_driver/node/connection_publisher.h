/// @file connection_publisher.h
#ifndef AIBO_DRIVER_NODE_CONNECTION_PUBLISHER_H
#define AIBO_DRIVER_NODE_CONNECTION_PUBLISHER_H

#include <aibo_driver/Connection.h>
#include <ros/node_handle.h>

#include <optional>
#include <string>

#include "aibo_client/rcserver_client.h"

namespace aibo_driver::node {

/// The robot's address as host:port.
std::string robotAddress(const aibo_client::ClientOptions& options);

/// Describes the connection in one line for people: its state, the reason for it, and what to check.
std::string describeConnection(const aibo_client::ConnectionStatus& status, const aibo_client::ClientOptions& options);

/// Publishes the latched topics `connection` and `streaming`.
class ConnectionPublisher {
 public:
  /// Publishes at once that there is neither a connection nor a stream yet.
  /// @param settings the namespace of the driver's parameters
  ConnectionPublisher(const ros::NodeHandle& handle, const std::string& settings,
                      const aibo_client::ClientOptions& options);

  /// Publishes the state if the message differs from the last one. It never blocks. Only one thread at a time may call
  /// it.
  void publish(const aibo_client::ConnectionStatus& status);
  void publishStreaming(bool streaming);

 private:
  const std::string settings_;
  const aibo_client::ClientOptions options_;
  ros::Publisher connection_;
  ros::Publisher streaming_;
  std::optional<Connection> last_;  ///< the last message that was published, without its stamp
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_CONNECTION_PUBLISHER_H
