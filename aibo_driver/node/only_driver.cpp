#include "node/only_driver.h"

#include <aibo_driver/Connection.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpcException.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "node/xmlrpc_peer.h"

namespace aibo_driver::node {
namespace {

using XmlRpc::XmlRpcValue;

[[noreturn]] void refuse(const std::string& name_space, const std::string& holder, const std::string& advice) {
  throw std::runtime_error("There is a driver in the namespace " + name_space + " already: " + holder + ". " + advice +
                           " For a second robot, start this one in another namespace.");
}

// The master cannot tell two nodelets of the same manager apart, so this process is checked first.
void refuseASecondOneInThisProcess(const ros::NodeHandle& handle) {
  ros::V_string topics;
  ros::this_node::getAdvertisedTopics(topics);
  if (std::count(topics.begin(), topics.end(), handle.resolveName("connection")) > 0) {
    refuse(handle.getNamespace(), "another nodelet of " + ros::this_node::getName(), "Unload it first.");
  }
}

/// @throw NoAnswer the node does not answer
bool publishes(const XmlRpcPeer& node, const std::string& topic) {
  auto publications = node.call("getPublications", {});
  try {
    for (int i = 0; publications && i < publications->size(); ++i) {
      if ((*publications)[i][0] == XmlRpcValue(topic)) {
        return true;
      }
    }
  } catch (const XmlRpc::XmlRpcException&) {
    // What answers is no node of ROS, or a node that publishes nothing.
  }
  return false;
}

/// @return what to do about a publisher if it runs, or if that is not certain; empty if it has ended. Another node may
///   have the address of one that was killed
std::string adviceAbout(const std::string& node, const std::string& topic, const XmlRpcPeer& master) {
  std::string host;
  std::uint32_t port = 0;
  auto uri = master.call("lookupNode", {node});
  if (!uri || !ros::network::splitURI(*uri, host, port)) {
    return "";
  }
  try {
    return publishes(XmlRpcPeer(host, port), topic) ? "End it first, for instance by rosnode kill " + node + "." : "";
  } catch (const NoAnswer& none) {
    return none.is_silent ? "It does not answer. If " + host + " is switched off, let the ROS master forget it by " +
                                "rosnode cleanup."
                          : "";
  }
}

}  // namespace

std::vector<std::string> publishersBefore(const std::string& node, const std::string& topic, XmlRpcValue system_state) {
  std::vector<std::string> publishers;
  for (int i = 0; i < system_state[0].size(); ++i) {
    XmlRpcValue& published = system_state[0][i];  // the topic and its publishers
    for (int j = 0; published[0] == XmlRpcValue(topic) && j < published[1].size(); ++j) {
      if (published[1][j] == XmlRpcValue(node)) {
        break;
      }
      publishers.push_back(published[1][j]);
    }
  }
  return publishers;
}

OnlyDriver::OnlyDriver(const ros::NodeHandle& handle) {
  refuseASecondOneInThisProcess(handle);
  // The claim is latched, as the driver's own publisher is, because programs that record topics believe the first one.
  constexpr bool kLatched = true;
  claim_ = ros::NodeHandle(handle).advertise<Connection>("connection", 1, kLatched);
  const XmlRpcPeer master = XmlRpcPeer::master();
  try {
    const auto state = master.call("getSystemState", {});
    const std::vector<std::string> earlier =
        state ? publishersBefore(ros::this_node::getName(), claim_.getTopic(), *state) : std::vector<std::string>();
    for (const std::string& node : earlier) {
      if (const std::string advice = adviceAbout(node, claim_.getTopic(), master); !advice.empty()) {
        refuse(handle.getNamespace(), "the node " + node, advice);
      }
    }
  } catch (const NoAnswer&) {
    // Without the master the answer is unknown, but without it no node can find this driver either.
  } catch (const XmlRpc::XmlRpcException&) {
    // The program that answers at the master's address is no master.
  }
}

}  // namespace aibo_driver::node
