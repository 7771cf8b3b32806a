/// @file expression_commander.h
#ifndef AIBO_DRIVER_ROS_BODY_EXPRESSION_COMMANDER_H
#define AIBO_DRIVER_ROS_BODY_EXPRESSION_COMMANDER_H

#include <aibo_driver/Ears.h>
#include <aibo_driver/Leds.h>
#include <ros/console.h>
#include <ros/node_handle.h>

#include <functional>
#include <string>

#include "aibo_driver/rcserver_client.h"
#include "robot_model/robot_model.h"
#include "ros/throttled_warnings.h"

namespace aibo_driver::node {

/// Takes commands from leds and ears, and sends them on. Nothing is kept while there is no connection. Everything runs
/// on the callback queue of the handle, which must be served by one thread.
class ExpressionCommander {
 public:
  /// @param model, client must outlive the commander
  ExpressionCommander(const ros::NodeHandle& handle, const robot_model::RobotModel& model, RcServerClient& client);

 private:
  void receiveLeds(const Leds& message);
  void receiveEars(const Ears& message);
  void send(const std::string& what, const std::function<void()>& command);

  const robot_model::RobotModel& model_;
  RcServerClient& client_;
  ThrottledWarnings warnings_{[](const std::string& text) { ROS_WARN_STREAM_NAMED("expression", text); }};
  ros::Subscriber leds_;
  ros::Subscriber ears_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_BODY_EXPRESSION_COMMANDER_H
