#include "remote_control/driver_search.h"

#include <aibo_driver/Connection.h>
#include <dynamic_reconfigure/Config.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <algorithm>

#include "node/xmlrpc_peer.h"

namespace aibo_driver::remote_control {
namespace {

using XmlRpc::XmlRpcValue;

const std::string kConnection = "/connection";
const std::string kSettings = "/parameter_updates";
const std::string kOwnSetting = "/telemetry_rate";  // nothing else has a setting of this name

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

bool hasType(const MasterState& state, const std::string& topic, const std::string& type) {
  const auto found = state.types.find(topic);
  return found != state.types.end() && found->second == type;
}

bool shareANode(const std::vector<std::string>& some, const std::vector<std::string>& others) {
  return std::any_of(some.begin(), some.end(), [&others](const std::string& node) {
    return std::find(others.begin(), others.end(), node) != others.end();
  });
}

}  // namespace

std::optional<MasterState> askMaster() {
  const auto master = node::XmlRpcPeer::master();
  std::optional<XmlRpcValue> topics;
  std::optional<XmlRpcValue> system;
  std::optional<XmlRpcValue> parameters;
  try {
    constexpr const char* kAnySubgraph = "";
    topics = master.call("getPublishedTopics", {kAnySubgraph});
    system = master.call("getSystemState", {});
    parameters = master.call("getParamNames", {});
  } catch (const node::NoAnswer&) {
    return std::nullopt;
  }
  if (!topics || !system || !parameters) {
    return std::nullopt;
  }
  MasterState state;
  for (int i = 0; i < topics->size(); ++i) {
    XmlRpcValue& topic = (*topics)[i];  // a name and a type
    state.types[topic[0]] = std::string(topic[1]);
  }
  XmlRpcValue& published = (*system)[0];
  for (int i = 0; i < published.size(); ++i) {
    XmlRpcValue& nodes = published[i][1];
    for (int j = 0; j < nodes.size(); ++j) {
      state.publishers[published[i][0]].push_back(nodes[j]);
    }
  }
  for (int i = 0; i < parameters->size(); ++i) {
    state.parameters.insert((*parameters)[i]);
  }
  return state;
}

std::vector<std::string> driversIn(const MasterState& state) {
  std::vector<std::string> found;
  for (const auto& [topic, type] : state.types) {
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

// A nodelet manager may have several drivers, each with a name in its own namespace, and one of these may be within
// another. The parameters and topics of a node that was started bare are in different namespaces.
std::string settingsOf(const std::string& name_space, const MasterState& state) {
  const auto driver = state.publishers.find(name_space + kConnection);
  if (driver == state.publishers.end()) {
    return "";
  }
  const std::vector<std::string> drivers = driversIn(state);
  std::string elsewhere;
  for (const auto& [topic, nodes] : state.publishers) {
    if (!endsWith(topic, kSettings) ||
        !hasType(state, topic, ros::message_traits::datatype<dynamic_reconfigure::Config>()) ||
        !shareANode(nodes, driver->second)) {
      continue;
    }
    const std::string owner = topic.substr(0, topic.size() - kSettings.size());
    if (state.parameters.count(owner + kOwnSetting) == 0) {
      continue;  // those of another nodelet, or of a plugin of image_transport
    }
    const auto has_it = [&owner](const std::string& space) { return owner.rfind(space + "/", 0) == 0; };
    const auto is_nearer = [&](const std::string& space) { return space.size() > name_space.size() && has_it(space); };
    if (has_it(name_space) && std::none_of(drivers.begin(), drivers.end(), is_nearer)) {
      return owner;
    }
    if (std::none_of(drivers.begin(), drivers.end(), has_it)) {
      elsewhere = owner;
    }
  }
  return elsewhere;
}

}  // namespace aibo_driver::remote_control
