/// @file led_memory.h
#ifndef AIBO_DRIVER_NODE_BODY_LED_MEMORY_H
#define AIBO_DRIVER_NODE_BODY_LED_MEMORY_H

#include <aibo_driver/LedStates.h>

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

  /// @return true if the robot was connected or lost, so that the states may have changed
  bool update(const aibo_client::ConnectionStatus& status);

  /// Notes LEDs that the robot has accepted. LEDs that this robot does not have are ignored.
  /// @return true if a state has changed
  bool accept(const std::vector<aibo_client::LedCommand>& leds);

  /// The message has no stamp.
  const LedStates& states() const { return states_; }

 private:
  void setAll(float intensity);

  const robot_model::RobotModel& model_;
  bool is_connected_ = false;
  LedStates states_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_BODY_LED_MEMORY_H
