#include "ros/master_watch.h"

#include <ros/connection_manager.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/names.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>
#include <xmlrpcpp/XmlRpcClient.h>
#include <xmlrpcpp/XmlRpcDispatch.h>
#include <xmlrpcpp/XmlRpcException.h>

#include <chrono>

namespace aibo_driver::node {
namespace {

using XmlRpc::XmlRpcDispatch;
using XmlRpc::XmlRpcValue;

constexpr std::chrono::seconds kPeriod{3};
constexpr std::chrono::seconds kPatience{2};  // for one answer
constexpr double kSlice = 50;                 // ms: so long an answer is waited for between two looks at the end
constexpr int kSuccess = 1;

struct NoAnswer {};

template <typename Function>
void forEach(const std::optional<XmlRpcValue>& values, Function function) {
  for (int i = 0; values && i < values->size(); ++i) {
    function((*values)[i]);
  }
}

bool contains(const XmlRpcValue& values, const std::string& text) {
  bool found = false;
  forEach(values, [&](const XmlRpcValue& value) { found = found || value == XmlRpcValue(text); });
  return found;
}

std::string ownUri() {
  return ros::XMLRPCManager::instance()->getServerURI();
}

}  // namespace

MasterWatch::MasterWatch(const std::string& parameters)
    : parameters_name_(parameters),
      sign_(ros::this_node::getName() + "/get_loggers"),
      thread_(&MasterWatch::run, this) {}

MasterWatch::~MasterWatch() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  ending_changed_.notify_one();
  thread_.join();
}

void MasterWatch::run() {
  while (!isEnding()) {
    try {
      look();
    } catch (const NoAnswer&) {
      // It will be back, and then it is asked again.
    } catch (const XmlRpc::XmlRpcException& error) {
      ROS_WARN_STREAM_ONCE_NAMED("master", "The ROS master's answer is none: " << error.getMessage());
    }
    std::unique_lock<std::mutex> lock(mutex_);
    ending_changed_.wait_for(lock, kPeriod, [this] { return ending_; });
  }
}

void MasterWatch::look() {
  const Server master{ros::master::getHost(), static_cast<int>(ros::master::getPort())};
  if (ask(master, "lookupService", {sign_})) {
    remember(master);
  } else {
    ROS_WARN_NAMED("master", "The ROS master does not know this node any more: it was restarted. Registering again.");
    introduceTo(master);
    ROS_INFO_NAMED("master", "The ROS master knows this node again.");
  }
}

void MasterWatch::remember(const Server& master) {
  if (const auto parameters = ask(master, "getParam", {parameters_name_})) {
    parameters_ = *parameters;
  }
  if (!services_.empty()) {
    return;
  }
  if (const auto state = ask(master, "getSystemState", {})) {
    forEach((*state)[2], [this](const XmlRpcValue& service) {
      const std::string name = service[0];
      if (name != sign_ && contains(service[1], ros::this_node::getName())) {
        services_.push_back(name);
      }
    });
  }
}

// What is published and subscribed to, this process tells by the same means as the master tells what it knows. The sign
// comes last: should the master go meanwhile, all is registered anew.
void MasterWatch::introduceTo(const Server& master) {
  const Server self{"127.0.0.1", static_cast<int>(ros::XMLRPCManager::instance()->getServerPort())};
  if (parameters_.valid() && !ask(master, "getParam", {parameters_name_})) {
    ask(master, "setParam", {parameters_name_, parameters_});
  }
  forEach(ask(self, "getPublications", {}), [&](const XmlRpcValue& topic) {
    ask(master, "registerPublisher", {topic[0], topic[1], ownUri()});
  });
  forEach(ask(self, "getSubscriptions", {}), [&](const XmlRpcValue& topic) {
    const auto publishers = ask(master, "registerSubscriber", {topic[0], topic[1], ownUri()});
    // Of none there is nothing to tell: those who publish to us now would be dropped.
    if (publishers && publishers->size() > 0) {
      ask(self, "publisherUpdate", {topic[0], *publishers});
    }
  });
  for (const std::string& service : services_) {
    registerService(master, service);
  }
  registerService(master, sign_);
}

void MasterWatch::registerService(const Server& master, const std::string& name) {
  const std::string uri =
      "rosrpc://" + ros::network::getHost() + ":" + std::to_string(ros::ConnectionManager::instance()->getTCPPort());
  ask(master, "registerService", {name, uri, ownUri()});
}

// ros::master::execute() would wait for as long as the server likes.
/// @return nothing if the answer is no
/// @throw NoAnswer none came in time, or all of this ends
std::optional<XmlRpcValue> MasterWatch::ask(const Server& server, const char* method,
                                            const std::vector<XmlRpcValue>& arguments) {
  XmlRpcValue request;
  request[0] = ros::this_node::getName();
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    request[static_cast<int>(i) + 1] = arguments[i];
  }
  XmlRpc::XmlRpcClient client(server.host.c_str(), server.port, "/");
  if (isEnding() || !client.executeNonBlock(method, request)) {
    throw NoAnswer();
  }
  XmlRpcDispatch dispatch;
  dispatch.addSource(&client, XmlRpcDispatch::WritableEvent | XmlRpcDispatch::Exception);
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!dispatch._sources.empty() && !isEnding() && std::chrono::steady_clock::now() < end) {
    dispatch.work(kSlice);
  }
  XmlRpcValue answer;  // done is also what failed; then it is not valid
  if (!client.executeCheckDone(answer) || client.isFault() || !answer.valid()) {
    throw NoAnswer();
  }
  return answer[0] == XmlRpcValue(kSuccess) ? std::optional<XmlRpcValue>(answer[2]) : std::nullopt;
}

// While ROS is being shut down it unregisters all that is registered.
bool MasterWatch::isEnding() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return ending_ || ros::isShuttingDown();
}

}  // namespace aibo_driver::node
