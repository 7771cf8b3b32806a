/// @file led_state_publisher.h
#ifndef AIBO_DRIVER_NODE_BODY_LED_STATE_PUBLISHER_H
#define AIBO_DRIVER_NODE_BODY_LED_STATE_PUBLISHER_H

#include <aibo_driver/LedStates.h>
#include <ros/node_handle.h>

#include <vector>

#include "aibo_client/rcserver_client.h"
#include "robot_model/robot_model.h"

namespace aibo_driver::node {

/// The state of the LEDs, as the robot has reported it. RCServer switches all LEDs off when a connection ends, so after
/// each connection to a version 2 server they are known to be off. A version 1 server may be an older one that leaves
/// the LEDs as they are. With such a server, an LED is unknown until the robot has accepted a command to it. Without a
/// connection all LEDs are unknown.
///
/// The class is not thread-safe.
class LedMemory {
 public:
  /// All LEDs are unknown at first.
  explicit LedMemory(const robot_model::RobotModel& model);

  /// @return true if the states have changed; accept() returns the same
  bool update(const aibo_client::ConnectionStatus& status);

  /// Notes LEDs that the robot has accepted. LEDs that this robot does not have are ignored.
  bool accept(const std::vector<aibo_client::LedCommand>& leds);

  /// The message has no stamp.
  const LedStates& states() const { return states_; }

 private:
  bool setAll(float intensity);
  bool set(std::size_t led, float intensity, aibo_client::LedMode mode);

  const robot_model::RobotModel& model_;
  bool is_connected_ = false;
  LedStates states_;
};

/// Publishes the latched topic `led_states`.
class LedStatePublisher {
 public:
  /// Publishes at once that no LED is known yet.
  /// @param model must outlive the publisher
  LedStatePublisher(const ros::NodeHandle& handle, const robot_model::RobotModel& model);

  /// These functions publish only changes. They never block. Only one thread at a time may call them.
  void update(const aibo_client::ConnectionStatus& status);
  void accept(const std::vector<aibo_client::LedCommand>& leds);

 private:
  void publish();

  LedMemory memory_;
  ros::Publisher publisher_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_BODY_LED_STATE_PUBLISHER_H
