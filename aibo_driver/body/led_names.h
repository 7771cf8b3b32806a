/// @file led_names.h
#ifndef AIBO_DRIVER_BODY_LED_NAMES_H
#define AIBO_DRIVER_BODY_LED_NAMES_H

#include <string>
#include <vector>

#include "robot_model/robot_model.h"

namespace aibo_driver::body {

/// What users call LEDs: each by its name, several by a group: face, head, back, tail, or all.
/// @return RCServer identifiers; empty if the robot has no LED and no group of this name
std::vector<int> findLeds(const std::string& name, const robot_model::RobotModel& model);

/// The names that findLeds() knows: groups that have an LED, then all LEDs.
std::vector<std::string> namesOfLeds(const robot_model::RobotModel& model);

/// An intensity on the wire, 0..255. Rounded up, so that the lowest intensity above 0 is not off.
/// @param intensity 0..1
int ledLevel(double intensity);

}  // namespace aibo_driver::body

#endif  // AIBO_DRIVER_BODY_LED_NAMES_H
