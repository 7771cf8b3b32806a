/// @file led_command.h
#ifndef AIBO_DRIVER_ROS_BODY_LED_COMMAND_H
#define AIBO_DRIVER_ROS_BODY_LED_COMMAND_H

#include <aibo_driver/Leds.h>

#include <string>
#include <vector>

#include "aibo_driver/leds.h"
#include "robot_model/robot_model.h"

namespace aibo_driver::node {

/// What a message asks of the LEDs, and what of it is refused.
struct LedOrders {
  std::vector<LedCommand> commands;   ///< each LED once
  std::vector<std::string> refusals;  ///< in words, for users
};

/// Finds the LEDs that a message names, by themselves or in groups; of an LED that is named twice, the later counts.
/// Left out: names that are no LED's and no group's, and intensities that are not 0..1. Arrays that do not fit
/// together, or a mode that there is not, refuse the whole message.
LedOrders parseLeds(const Leds& message, const robot_model::RobotModel& model);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_BODY_LED_COMMAND_H
