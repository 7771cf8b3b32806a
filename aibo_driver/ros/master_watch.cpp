#include "ros/master_watch.h"

#include <ros/connection_manager.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>
#include <xmlrpcpp/XmlRpcClient.h>
#include <xmlrpcpp/XmlRpcDispatch.h>
#include <xmlrpcpp/XmlRpcException.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <chrono>
#include <optional>
#include <vector>

namespace aibo_driver::node {
namespace {

using XmlRpc::XmlRpcDispatch;
using XmlRpc::XmlRpcValue;

constexpr std::chrono::seconds kQuestionPeriod{5};
constexpr std::chrono::seconds kAnswerTimeout{2};
constexpr double kSlice = 0.05;  // s: how often a call that waits looks whether the watch ends
constexpr int kSuccess = 1;      // the status of an answer, http://wiki.ros.org/ROS/Master_API

struct NoAnswer {};

/// Somebody who answers XML-RPC: the master, or this process.
class Peer {
 public:
  Peer(const std::string& host, std::uint32_t port, const std::shared_future<void>& ended)
      : host_(host), port_(static_cast<int>(port)), ended_(ended) {}

  /// Calls a method. Unlike ros::master::execute() it does not wait for ever.
  /// @return empty if the call was refused
  /// @throw NoAnswer none came in time, or the watch ends
  std::optional<XmlRpcValue> call(const char* method, const std::vector<XmlRpcValue>& arguments) const {
    XmlRpcValue request;
    request[0] = ros::this_node::getName();
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      request[static_cast<int>(i) + 1] = arguments[i];
    }
    XmlRpc::XmlRpcClient client(host_.c_str(), port_, "/");
    if (isEnding() || !client.executeNonBlock(method, request)) {
      throw NoAnswer();
    }
    XmlRpcDispatch dispatch;
    dispatch.addSource(&client, XmlRpcDispatch::WritableEvent | XmlRpcDispatch::Exception);
    const auto end = std::chrono::steady_clock::now() + kAnswerTimeout;
    while (!dispatch._sources.empty() && !isEnding() && std::chrono::steady_clock::now() < end) {
      dispatch.work(kSlice);
    }
    XmlRpcValue answer;  // a call that failed counts as done, but its answer is not valid
    if (!client.executeCheckDone(answer) || client.isFault() || !answer.valid()) {
      throw NoAnswer();
    }
    return answer[0] == XmlRpcValue(kSuccess) ? std::optional<XmlRpcValue>(answer[2]) : std::nullopt;
  }

 private:
  // While roscpp shuts down, it unregisters everything, so nothing may be registered again.
  bool isEnding() const {
    return ended_.wait_for(std::chrono::seconds(0)) == std::future_status::ready || ros::isShuttingDown();
  }

  const std::string host_;
  const int port_;
  const std::shared_future<void> ended_;
};

/// What a new master has to be told about this process.
class Registration {
 public:
  Registration(const std::string& parameters_name, const std::shared_future<void>& ended)
      : parameters_name_(parameters_name),
        sign_(ros::this_node::getName() + "/get_loggers"),
        own_uri_(ros::XMLRPCManager::instance()->getServerURI()),
        service_uri_("rosrpc://" + ros::network::getHost() + ":" +
                     std::to_string(ros::ConnectionManager::instance()->getTCPPort())),
        master_(ros::master::getHost(), ros::master::getPort(), ended),
        self_("127.0.0.1", ros::XMLRPCManager::instance()->getServerPort(), ended) {}

  /// Asks the master once whether it knows this process, and registers it if not.
  void check() {
    if (master_.call("lookupService", {sign_})) {
      remember();
      return;
    }
    ROS_WARN_NAMED("master", "The ROS master does not know this node any more: it was restarted. Registering again.");
    registerAll();
    ROS_INFO_NAMED("master", "The ROS master knows this node again.");
  }

 private:
  // roscpp cannot list the services of this process, but the master can.
  void remember() {
    if (const auto parameters = master_.call("getParam", {parameters_name_})) {
      parameters_ = *parameters;
    }
    if (!services_.empty()) {
      return;
    }
    auto state = master_.call("getSystemState", {});
    for (int i = 0; state && i < (*state)[2].size(); ++i) {
      XmlRpcValue& service = (*state)[2][i];  // its name, and the nodes that provide it
      for (int j = 0; j < service[1].size(); ++j) {
        if (service[1][j] == XmlRpcValue(ros::this_node::getName()) && service[0] != XmlRpcValue(sign_)) {
          services_.push_back(service[0]);
        }
      }
    }
  }

  void registerAll() {
    if (parameters_.valid() && !master_.call("getParam", {parameters_name_})) {
      master_.call("setParam", {parameters_name_, parameters_});
    }
    auto publications = self_.call("getPublications", {});
    for (int i = 0; publications && i < publications->size(); ++i) {
      XmlRpcValue& topic = (*publications)[i];  // name and type
      master_.call("registerPublisher", {topic[0], topic[1], own_uri_});
    }
    auto subscriptions = self_.call("getSubscriptions", {});
    for (int i = 0; subscriptions && i < subscriptions->size(); ++i) {
      XmlRpcValue& topic = (*subscriptions)[i];
      const auto publishers = master_.call("registerSubscriber", {topic[0], topic[1], own_uri_});
      // An empty list would drop those who publish to this process now.
      if (publishers && publishers->size() > 0) {
        self_.call("publisherUpdate", {topic[0], *publishers});
      }
    }
    // The sign comes last: if the master goes away before, everything is registered again.
    std::vector<std::string> services = services_;
    services.push_back(sign_);
    for (const std::string& service : services) {
      master_.call("registerService", {service, service_uri_, own_uri_});
    }
  }

  const std::string parameters_name_;
  const std::string sign_;  ///< a service that every node has: a master that knows it knows all the others, too
  const std::string own_uri_;
  const std::string service_uri_;
  const Peer master_;
  const Peer self_;
  XmlRpcValue parameters_;             ///< as the master last had them
  std::vector<std::string> services_;  ///< what this process advertised when the watch began, except the sign
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
