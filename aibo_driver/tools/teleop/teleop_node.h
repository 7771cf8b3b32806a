/// @file teleop_node.h
/// What the nodes that steer by keys and by a joystick have in common.
#ifndef AIBO_DRIVER_TOOLS_TELEOP_TELEOP_NODE_H
#define AIBO_DRIVER_TOOLS_TELEOP_TELEOP_NODE_H

#include <aibo_driver/RobotState.h>
#include <geometry_msgs/Twist.h>
#include <ros/console.h>
#include <ros/node_handle.h>
#include <ros/service.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <future>
#include <string>

#include "node/stop_client.h"
#include "node/xmlrpc_peer.h"
#include "text/plain_text.h"
#include "tools/teleop/key_steering.h"

namespace teleop {

/// The parameters ~speed and ~side_speed, 0..1 m/s, and ~turn_speed, 0..10 rad/s. One that is not set has its usual
/// value.
/// @throw std::runtime_error a parameter is no number, or out of its range; the message names it
Speeds readSpeeds(const ros::NodeHandle& parameters);

geometry_msgs::Twist toTwist(const aibo_client::WalkVelocity& velocity);

/// Logs the answer of a service.
/// @param response the answer; null if there was none
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

  /// Calls a service. If the previous call has not ended yet, it only logs a warning. Only one thread may call it.
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

/// Stops the robot, and lets it move again. Only one thread may call it and serve the handle's callbacks.
class StopAndRelease {
 public:
  /// @param handle a handle in the driver's namespace
  /// @param how a sentence for the user about how to release the robot
  /// @param tell shows the user who has stopped the robot, and that it may move again
  StopAndRelease(ros::NodeHandle handle, std::string how, std::function<void(const std::string&)> tell);

  /// Stops the robot (StopClient).
  void stop();

  /// Lets the robot move again, if somebody has stopped it.
  /// @return false if nobody has stopped it
  bool release();

 private:
  void receive(const aibo_driver::RobotState::ConstPtr& state);

  const std::string how_;
  const std::function<void(const std::string&)> tell_;
  std::string stopped_by_;  ///< empty while the robot may move
  aibo_driver::node::StopClient stop_;
  ServiceCaller release_;
  ros::Subscriber states_;
};

}  // namespace teleop

#endif  // AIBO_DRIVER_TOOLS_TELEOP_TELEOP_NODE_H
