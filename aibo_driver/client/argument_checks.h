/// @file argument_checks.h
/// What RcServerClient's commands to the body take. Everything here throws InvalidArgumentException naming what is
/// wrong.
#ifndef AIBO_DRIVER_CLIENT_ARGUMENT_CHECKS_H
#define AIBO_DRIVER_CLIENT_ARGUMENT_CHECKS_H

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "aibo_driver/joints.h"
#include "aibo_driver/leds.h"

namespace aibo_driver {

void checkJointTargets(const std::vector<JointTarget>& targets, std::chrono::milliseconds duration);
void checkJointSpeedLimits(const std::vector<JointSpeedLimit>& limits);
void checkLedCommands(const std::vector<LedCommand>& leds);
void checkMotionContent(const std::vector<std::uint8_t>& content);

/// @return the name as it goes over the wire
std::string checkedMotionName(const std::string& name);

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_ARGUMENT_CHECKS_H
