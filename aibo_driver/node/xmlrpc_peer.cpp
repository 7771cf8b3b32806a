#include "node/xmlrpc_peer.h"

#include <ros/init.h>
#include <ros/master.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpcClient.h>
#include <xmlrpcpp/XmlRpcDispatch.h>

#include <chrono>

namespace aibo_driver::node {
namespace {

using XmlRpc::XmlRpcDispatch;
using XmlRpc::XmlRpcValue;

constexpr std::chrono::seconds kAnswerTimeout{2};
constexpr double kSlice = 0.05;  // s; how often a call that waits checks whether it has to end

// The parts of an answer, which is an array: http://wiki.ros.org/ROS/Master_API
enum { kStatus, kMessage, kResult, kParts };
constexpr int kSuccess = 1;

}  // namespace

XmlRpcPeer XmlRpcPeer::master(const std::shared_future<void>& ended) {
  return {ros::master::getHost(), ros::master::getPort(), ended};
}

std::optional<XmlRpcValue> XmlRpcPeer::call(const char* method, const std::vector<XmlRpcValue>& arguments) const {
  XmlRpcValue request;
  request[0] = ros::this_node::getName();
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    request[static_cast<int>(i) + 1] = arguments[i];
  }
  XmlRpc::XmlRpcClient client(host_.c_str(), port_, "/");
  if (isEnding() || !client.executeNonBlock(method, request)) {
    throw NoAnswer{false};
  }
  XmlRpcDispatch dispatch;
  dispatch.addSource(&client, XmlRpcDispatch::WritableEvent | XmlRpcDispatch::Exception);
  const auto end = std::chrono::steady_clock::now() + kAnswerTimeout;
  for (bool is_late = false; !dispatch._sources.empty() && !isEnding() && !is_late;) {
    is_late = std::chrono::steady_clock::now() >= end;
    dispatch.work(is_late ? 0 : kSlice);  // the answer may have come while this process stalled
  }
  XmlRpcValue answer;  // a call that failed counts as done, but its answer is not valid
  if (!client.executeCheckDone(answer) || client.isFault() || answer.getType() != XmlRpcValue::TypeArray ||
      answer.size() != kParts) {
    throw NoAnswer{!dispatch._sources.empty()};
  }
  return answer[kStatus] == XmlRpcValue(kSuccess) ? std::optional<XmlRpcValue>(answer[kResult]) : std::nullopt;
}

// roscpp unregisters everything while it shuts down, so nothing may be registered again then.
bool XmlRpcPeer::isEnding() const {
  const bool has_ended = ended_.valid() && ended_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  return has_ended || ros::isShuttingDown();
}

bool isAdvertised(const std::string& service, const std::shared_future<void>& ended) {
  try {
    return XmlRpcPeer::master(ended).call("lookupService", {service}).has_value();
  } catch (const NoAnswer&) {
    return false;
  }
}

}  // namespace aibo_driver::node
