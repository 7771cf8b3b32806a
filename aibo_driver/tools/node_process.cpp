#include "tools/node_process.h"

#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpcClient.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <cstdint>
#include <ctime>

namespace aibo_driver::tools {

std::optional<pid_t> processOfNode(const std::string& node_name) {
  XmlRpc::XmlRpcValue lookup;
  lookup[0] = ros::this_node::getName();
  lookup[1] = node_name;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue node_uri;
  if (!ros::master::execute("lookupNode", lookup, response, node_uri, false)) {
    return std::nullopt;
  }
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(static_cast<std::string&>(node_uri), host, port) || host != ros::network::getHost()) {
    return std::nullopt;
  }
  XmlRpc::XmlRpcClient node(host.c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue caller;
  caller[0] = ros::this_node::getName();
  XmlRpc::XmlRpcValue answer;  // status code, status text, process
  if (!node.execute("getPid", caller, answer) || node.isFault() || answer.getType() != XmlRpc::XmlRpcValue::TypeArray ||
      answer.size() != 3 || answer[2].getType() != XmlRpc::XmlRpcValue::TypeInt) {
    return std::nullopt;
  }
  return static_cast<pid_t>(static_cast<int&>(answer[2]));
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
