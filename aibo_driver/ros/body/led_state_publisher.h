/// @file led_state_publisher.h
#ifndef AIBO_DRIVER_ROS_BODY_LED_STATE_PUBLISHER_H
#define AIBO_DRIVER_ROS_BODY_LED_STATE_PUBLISHER_H

#include <aibo_driver/LedStates.h>
#include <ros/node_handle.h>

#include <vector>

#include "aibo_driver/rcserver_client.h"
#include "robot_model/robot_model.h"

namespace aibo_driver::node {

/// How the LEDs shine, as far as the robot has said it. RCServer switches all LEDs off when a connection ends, so after
/// each connection to a version 2 server they are known to be off. A version 1 server may be an older one that leaves
/// them as they are: with it, an LED is unknown until the robot has accepted a command to it. Without a connection all
/// are unknown.
///
/// Not thread-safe.
class LedMemory {
 public:
  /// All are unknown at first.
  explicit LedMemory(const robot_model::RobotModel& model);

  /// @return true if anything has changed; so do the other functions
  bool update(const ConnectionStatus& status);

  /// LEDs that this robot does not have are left out.
  bool accept(const std::vector<LedCommand>& leds);

  /// Without a stamp.
  const LedStates& states() const { return states_; }

 private:
  bool setAll(float intensity);
  bool set(std::size_t led, float intensity, LedMode mode);

  const robot_model::RobotModel& model_;
  bool is_connected_ = false;
  LedStates states_;
};

/// Publishes the latched topic `led_states`.
class LedStatePublisher {
 public:
  /// Publishes at once that nothing is known yet.
  /// @param model must outlive the publisher
  LedStatePublisher(const ros::NodeHandle& handle, const robot_model::RobotModel& model);

  /// These publish only what has changed. They never block. From one thread at a time.
  void update(const ConnectionStatus& status);
  void accept(const std::vector<LedCommand>& leds);

 private:
  void publish();

  LedMemory memory_;
  ros::Publisher publisher_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_BODY_LED_STATE_PUBLISHER_H
