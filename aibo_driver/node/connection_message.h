/// @file connection_message.h
/// What the driver says about its connection to the robot.
#ifndef AIBO_DRIVER_NODE_CONNECTION_MESSAGE_H
#define AIBO_DRIVER_NODE_CONNECTION_MESSAGE_H

#include <aibo_driver/Connection.h>

#include <string>

#include "aibo_client/rcserver_client.h"

namespace aibo_driver::node {

/// The robot's address as host:port.
std::string robotAddress(const aibo_client::ClientOptions& options);

/// Describes the connection in one line for people: its state, the reason for it, and what to check.
std::string describeConnection(const aibo_client::ConnectionStatus& status, const aibo_client::ClientOptions& options);

/// The message of the topic `connection`, without a stamp.
/// @param settings the namespace of the driver's parameters
Connection toMessage(const aibo_client::ConnectionStatus& status, const aibo_client::ClientOptions& options,
                     const std::string& settings);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_CONNECTION_MESSAGE_H
