#include "remote_control/driver_search.h"

#include <aibo_driver/Connection.h>
#include <xmlrpcpp/XmlRpcException.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <algorithm>

#include "node/xmlrpc_peer.h"

namespace aibo_driver::remote_control {
namespace {

using XmlRpc::XmlRpcValue;

const std::string kConnection = "/connection";

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

std::optional<TopicTypes> askMaster() {
  try {
    constexpr const char* kAnySubgraph = "";
    const auto topics = node::XmlRpcPeer::master().call("getPublishedTopics", {kAnySubgraph});
    if (!topics) {
      return std::nullopt;
    }
    TopicTypes types;
    for (int i = 0; i < topics->size(); ++i) {
      const XmlRpcValue& topic = (*topics)[i];  // a topic's name and type
      types[topic[0]] = std::string(topic[1]);
    }
    return types;
  } catch (const node::NoAnswer&) {
    return std::nullopt;
  } catch (const XmlRpc::XmlRpcException&) {  // the program that answers is no master
    return std::nullopt;
  }
}

std::vector<std::string> driversIn(const TopicTypes& types) {
  std::vector<std::string> found;
  for (const auto& [topic, type] : types) {
    if (endsWith(topic, kConnection) && type == ros::message_traits::datatype<Connection>()) {
      found.push_back(topic.substr(0, topic.size() - kConnection.size()));
    }
  }
  return found;
}

std::string driverAfter(const std::string& name_space, const std::vector<std::string>& found) {
  if (found.empty()) {
    return name_space;
  }
  const auto next = std::upper_bound(found.begin(), found.end(), name_space);
  return next == found.end() ? found.front() : *next;
}

}  // namespace aibo_driver::remote_control
