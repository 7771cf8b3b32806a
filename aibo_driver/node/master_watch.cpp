#include "node/master_watch.h"

#include <ros/connection_manager.h>
#include <ros/console.h>
#include <ros/network.h>
#include <ros/service_manager.h>
#include <ros/service_publication.h>
#include <ros/this_node.h>
#include <ros/transport/transport_tcp.h>
#include <ros/xmlrpc_manager.h>
#include <xmlrpcpp/XmlRpcException.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <iterator>
#include <set>
#include <utility>

#include "node/xmlrpc_peer.h"

namespace aibo_driver::node {
namespace {

using XmlRpc::XmlRpcValue;

constexpr std::chrono::seconds kQuestionPeriod{5};

using Names = std::set<std::string>;

/// Where roscpp listens for users of services. Nothing once roscpp has shut down: its own getTCPPort() then aborts the
/// process, which happened when Ctrl-C came in the first moments of a node.
std::string serviceUri() {
  const ros::TransportTCPPtr server = ros::ConnectionManager::instance()->getTCPServerTransport();
  return server ? "rosrpc://" + ros::network::getHost() + ":" + std::to_string(server->getServerPort()) : "";
}

/// What the master knows about this process, and what it has to be told.
class Registration {
 public:
  Registration(const std::string& parameters_name, const std::shared_future<void>& ended)
      : parameters_name_(parameters_name),
        own_name_(ros::this_node::getName()),
        own_uri_(ros::XMLRPCManager::instance()->getServerURI()),
        service_uri_(serviceUri()),
        master_(XmlRpcPeer::master(ended)),
        self_("127.0.0.1", ros::XMLRPCManager::instance()->getServerPort(), ended) {}

  /// Asks the master once what it knows about this process, and registers the rest.
  void check() {
    auto state = master_.call("getSystemState", {});
    if (!state) {
      return;
    }
    const Names known_publications = ownNamesIn((*state)[0]);
    const Names known_subscriptions = ownNamesIn((*state)[1]);
    const Names known_services = ownNamesIn((*state)[2]);
    // roscpp cannot list the services of this process, so we remember them.
    services_.insert(known_services.begin(), known_services.end());
    const Missing missing{without(known_publications, topicsOf(ros::this_node::getAdvertisedTopics)),
                          without(known_subscriptions, topicsOf(ros::this_node::getSubscribedTopics)),
                          without(known_services, advertisedServices())};
    const std::size_t missing_before = std::exchange(missing_, missing.count());
    if (missing.count() == 0) {
      rememberParameters();
      return;
    }
    // What is just being advertised is missing once. A master that was restarted knows none of the services.
    if (!known_services.empty() && missing_before == 0) {
      return;
    }
    if (known_services.empty()) {
      ROS_WARN_NAMED("master", "The ROS master does not know this node any more: it was restarted. Registering again.");
    } else {
      ROS_WARN_STREAM_NAMED("master", "The ROS master has lost "
                                          << missing.count() << " topics and services of this node, such as "
                                          << missing.example() << ". Did another node with the same names run? "
                                          << "Registering again.");
    }
    registerAgain(missing);
    ROS_INFO_NAMED("master", "The ROS master knows this node again.");
  }

 private:
  /// What this process has but the master does not know.
  struct Missing {
    Names publications;
    Names subscriptions;
    Names services;

    std::size_t count() const { return publications.size() + subscriptions.size() + services.size(); }
    const std::string& example() const {
      return *(services.empty() ? publications.empty() ? subscriptions : publications : services).begin();
    }
  };

  static Names without(const Names& known, const Names& own) {
    Names missing;
    std::set_difference(own.begin(), own.end(), known.begin(), known.end(), std::inserter(missing, missing.end()));
    return missing;
  }

  static Names topicsOf(void (*list)(ros::V_string&)) {
    ros::V_string topics;
    list(topics);
    return {topics.begin(), topics.end()};
  }

  /// Those services that the master ever knew and that are still advertised. A nodelet may have been unloaded.
  Names advertisedServices() const {
    Names advertised;
    std::copy_if(services_.begin(), services_.end(), std::inserter(advertised, advertised.end()),
                 [](const std::string& service) {
                   return ros::ServiceManager::instance()->lookupServicePublication(service) != nullptr;
                 });
    return advertised;
  }

  /// @param entries each entry has a name and the nodes that have it
  Names ownNamesIn(XmlRpcValue& entries) const {
    Names names;
    for (int i = 0; i < entries.size(); ++i) {
      XmlRpcValue& nodes = entries[i][1];
      for (int j = 0; j < nodes.size(); ++j) {
        if (nodes[j] == XmlRpcValue(own_name_)) {
          names.insert(entries[i][0]);
        }
      }
    }
    return names;
  }

  void rememberParameters() {
    if (const auto parameters = master_.call("getParam", {parameters_name_})) {
      parameters_ = *parameters;
    }
  }

  // If the master goes away meanwhile, the next check finds what is still missing.
  void registerAgain(const Missing& missing) {
    if (parameters_.valid() && !master_.call("getParam", {parameters_name_})) {
      master_.call("setParam", {parameters_name_, parameters_});
    }
    auto publications = self_.call("getPublications", {});
    for (int i = 0; publications && i < publications->size(); ++i) {
      XmlRpcValue& topic = (*publications)[i];  // a name and a type
      if (missing.publications.count(topic[0]) > 0) {
        master_.call("registerPublisher", {topic[0], topic[1], own_uri_});
      }
    }
    auto subscriptions = self_.call("getSubscriptions", {});
    for (int i = 0; subscriptions && i < subscriptions->size(); ++i) {
      XmlRpcValue& topic = (*subscriptions)[i];
      if (missing.subscriptions.count(topic[0]) == 0) {
        continue;
      }
      const auto publishers = master_.call("registerSubscriber", {topic[0], topic[1], own_uri_});
      // An empty list would drop those who publish to this process now.
      if (publishers && publishers->size() > 0) {
        self_.call("publisherUpdate", {topic[0], *publishers});
      }
    }
    for (const std::string& service : missing.services) {
      master_.call("registerService", {service, service_uri_, own_uri_});
    }
  }

  const std::string parameters_name_;
  const std::string own_name_;
  const std::string own_uri_;
  const std::string service_uri_;
  const XmlRpcPeer master_;
  const XmlRpcPeer self_;
  XmlRpcValue parameters_;   ///< as the master had them last
  Names services_;           ///< all services that the master ever knew
  std::size_t missing_ = 0;  ///< how many names in the last check
};

}  // namespace

MasterWatch::MasterWatch(const std::string& parameters) : thread_(&MasterWatch::run, this, parameters) {}

MasterWatch::~MasterWatch() {
  end_.set_value();
  thread_.join();
}

void MasterWatch::run(const std::string& parameters) {
  Registration registration(parameters, ended_);
  do {
    try {
      registration.check();
    } catch (const NoAnswer&) {
      // The master is asked again later.
    } catch (const XmlRpc::XmlRpcException& error) {
      ROS_WARN_STREAM_ONCE_NAMED("master", "The ROS master's answer cannot be understood: " << error.getMessage());
    }
  } while (ended_.wait_for(kQuestionPeriod) == std::future_status::timeout);
}

}  // namespace aibo_driver::node
