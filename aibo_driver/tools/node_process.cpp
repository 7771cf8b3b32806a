#include "tools/node_process.h"

#include <ros/network.h>
#include <xmlrpcpp/XmlRpcException.h>

#include <cstdint>
#include <ctime>

#include "node/xmlrpc_peer.h"

namespace aibo_driver::tools {

std::optional<pid_t> processOfNode(const std::string& node_name) {
  using node::XmlRpcPeer;
  try {
    auto uri = XmlRpcPeer::master().call("lookupNode", {node_name});
    std::string host;
    std::uint32_t port = 0;
    if (!uri || !ros::network::splitURI(*uri, host, port) || host != ros::network::getHost()) {
      return std::nullopt;
    }
    auto process = XmlRpcPeer(host, port).call("getPid", {});
    return process ? std::optional<pid_t>(static_cast<int&>(*process)) : std::nullopt;
  } catch (const node::NoAnswer&) {
    return std::nullopt;
  } catch (const XmlRpc::XmlRpcException&) {
    return std::nullopt;  // an answer of another type
  }
}

std::optional<std::chrono::nanoseconds> processorTime(pid_t process) {
  clockid_t clock{};
  timespec used{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &used) != 0) {
    return std::nullopt;
  }
  return std::chrono::seconds(used.tv_sec) + std::chrono::nanoseconds(used.tv_nsec);
}

}  // namespace aibo_driver::tools
