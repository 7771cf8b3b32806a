/// @file xmlrpc_peer.h
#ifndef AIBO_DRIVER_NODE_XMLRPC_PEER_H
#define AIBO_DRIVER_NODE_XMLRPC_PEER_H

#include <xmlrpcpp/XmlRpcValue.h>

#include <cstdint>
#include <future>
#include <optional>
#include <string>
#include <vector>

namespace aibo_driver::node {

/// Thrown if no answer came.
struct NoAnswer {
  bool is_silent;  ///< true: no answer came in time; false: nobody is there, or a program that is no part of ROS
};

/// A program that answers XML-RPC: the ROS master or a node.
class XmlRpcPeer {
 public:
  /// @param ended if it is valid, calls end at once as soon as it is ready
  XmlRpcPeer(const std::string& host, std::uint32_t port, const std::shared_future<void>& ended = {})
      : host_(host), port_(static_cast<int>(port)), ended_(ended) {}

  /// The ROS master of this process.
  static XmlRpcPeer master(const std::shared_future<void>& ended = {});

  /// Calls a method, with the name of this node as its first argument. Unlike ros::master::execute(), it waits for 2 s
  /// at most, not for ever. Any thread may call it.
  /// @return empty if the call was refused. A program that is no part of ROS can answer with any value
  /// @throw NoAnswer no answer came in time, or calls have to end
  std::optional<XmlRpc::XmlRpcValue> call(const char* method, const std::vector<XmlRpc::XmlRpcValue>& arguments) const;

 private:
  bool isEnding() const;

  const std::string host_;
  const int port_;
  const std::shared_future<void> ended_;
};

/// Whether the ROS master knows a service. Unlike roscpp's own search, it waits for the master for 2 s at most. Any
/// thread may call it.
/// @param service the name with its namespace
/// @param ended see XmlRpcPeer
/// @return true if the master knows the service; false also if the master does not answer
bool isAdvertised(const std::string& service, const std::shared_future<void>& ended = {});

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_XMLRPC_PEER_H
