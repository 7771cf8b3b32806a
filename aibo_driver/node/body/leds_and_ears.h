/// @file leds_and_ears.h
#ifndef AIBO_DRIVER_NODE_BODY_LEDS_AND_EARS_H
#define AIBO_DRIVER_NODE_BODY_LEDS_AND_EARS_H

#include <aibo_driver/Ears.h>
#include <aibo_driver/Leds.h>
#include <ros/console.h>
#include <ros/node_handle.h>

#include <functional>
#include <string>
#include <vector>

#include "aibo_client/rcserver_client.h"
#include "movement/mover.h"
#include "robot_model/robot_model.h"
#include "text/plain_text.h"
#include "text/throttled_warnings.h"

namespace aibo_driver::node {

/// The commands in a message to the LEDs, and the reasons why parts of it were refused.
struct ParsedLeds {
  std::vector<aibo_client::LedCommand> commands;  ///< each LED appears once
  text::FirstThree refusals{300};                 ///< sentences for users
};

/// Finds the LEDs that a message names, singly or in groups. If an LED is named twice, the last intensity counts. A
/// name that belongs to no LED and no group is left out, and so is an intensity outside of 0..1. The whole message is
/// refused if its arrays do not fit together, or if there is no such mode.
ParsedLeds parseLeds(const Leds& message, const robot_model::RobotModel& model);

/// Sends to the robot what nodes publish on the topics leds and ears. Without a connection, it drops the commands. The
/// mover may refuse a command to the ears.
///
/// Only one thread at a time may use an object of this class.
class LedsAndEars {
 public:
  /// @param model, client, mover must outlive the commander
  LedsAndEars(const robot_model::RobotModel& model, aibo_client::RcServerClient& client, const movement::Mover& mover)
      : model_(model), client_(client), mover_(mover) {}

  /// @param handle a handle whose callback queue is served by one thread
  void subscribe(const ros::NodeHandle& handle);

  /// These functions log what could not be sent.
  void receiveLeds(const Leds& message);
  void receiveEars(const Ears& message, const movement::Order& order);

 private:
  void send(const std::string& what, const std::function<void()>& command);

  const robot_model::RobotModel& model_;
  aibo_client::RcServerClient& client_;
  const movement::Mover& mover_;
  text::ThrottledWarnings warnings_{[](const std::string& text) { ROS_WARN_STREAM_NAMED("expression", text); }};
  ros::Subscriber leds_;
  ros::Subscriber ears_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_BODY_LEDS_AND_EARS_H
