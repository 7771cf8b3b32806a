/// @file service_caller.h
#ifndef AIBO_DRIVER_TOOLS_TELEOP_SERVICE_CALLER_H
#define AIBO_DRIVER_TOOLS_TELEOP_SERVICE_CALLER_H

#include <ros/console.h>
#include <ros/node_handle.h>
#include <ros/service.h>

#include <chrono>
#include <cstddef>
#include <future>
#include <string>

#include "node/xmlrpc_peer.h"
#include "text/plain_text.h"

namespace teleop {

/// Logs the answer of a service.
/// @param response null if there was none
template <typename Response>
void logAnswer(const std::string& service, const Response* response) {
  constexpr std::size_t kLongestMessage = 1000;  // bytes
  if (response == nullptr) {
    ROS_WARN_STREAM("The service " << service << " cannot be called: do the driver and the ROS master run?");
  } else if (response->success) {
    ROS_INFO_STREAM(service << ": " << aibo_driver::text::plainLine(response->message, kLongestMessage));
  } else {
    ROS_WARN_STREAM(service << ": " << aibo_driver::text::plainLine(response->message, kLongestMessage));
  }
}

/// Calls one service at a time in a thread of its own, so that steering goes on. The answers go to the log.
class ServiceCaller {
 public:
  explicit ServiceCaller(const ros::NodeHandle& handle) : handle_(handle) {}

  /// Calls a service. If the previous call has not ended yet, it only warns. Only one thread may call it.
  template <typename Service>
  void call(const std::string& name, const typename Service::Request& request) {
    if (call_.valid() && call_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
      ROS_WARN_STREAM(name << " is not called: the previous call has not ended yet.");
      return;
    }
    call_ = std::async(std::launch::async, [service = handle_.resolveName(name), request] {
      typename Service::Response response;
      typename Service::Request copy = request;
      // Without the first condition, roscpp would wait for a master that hangs.
      const bool answered = aibo_driver::node::isAdvertised(service) && ros::service::call(service, copy, response);
      logAnswer(service, answered ? &response : nullptr);
    });
  }

 private:
  const ros::NodeHandle handle_;
  std::future<void> call_;
};

}  // namespace teleop

#endif  // AIBO_DRIVER_TOOLS_TELEOP_SERVICE_CALLER_H
