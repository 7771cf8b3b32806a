/// @file teleop_node.h
/// What the nodes that steer by keys and by a joystick have in common.
#ifndef AIBO_DRIVER_TOOLS_TELEOP_TELEOP_NODE_H
#define AIBO_DRIVER_TOOLS_TELEOP_TELEOP_NODE_H

#include <aibo_driver/RobotState.h>
#include <geometry_msgs/Twist.h>
#include <ros/console.h>
#include <ros/node_handle.h>

#include <cstddef>
#include <functional>
#include <string>

#include "node/service_calls.h"
#include "node/stop_client.h"
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

/// Calls a service without waiting for it, so that steering goes on. The answer goes to the log.
/// @param service its name with its namespace
template <typename Service>
void call(aibo_driver::node::ServiceCalls& calls, const std::string& service,
          const typename Service::Request& request) {
  const auto log = [service](const typename Service::Response* response) { logAnswer(service, response); };
  if (!calls.start<Service>(service, request, log)) {
    ROS_WARN_STREAM(service << " is not called: the previous call has not ended yet.");
  }
}

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
  const std::string release_;  ///< the service
  aibo_driver::node::ServiceCalls calls_;
  ros::Subscriber states_;
};

}  // namespace teleop

#endif  // AIBO_DRIVER_TOOLS_TELEOP_TELEOP_NODE_H
