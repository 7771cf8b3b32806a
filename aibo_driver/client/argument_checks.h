/// @file argument_checks.h
/// Checks the arguments of RcServerClient. Every function throws InvalidArgumentException if a value is not allowed.
/// The message names the value and its range.
#ifndef AIBO_DRIVER_CLIENT_ARGUMENT_CHECKS_H
#define AIBO_DRIVER_CLIENT_ARGUMENT_CHECKS_H

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "aibo_client/colors.h"
#include "aibo_client/options.h"
#include "aibo_client/parts.h"
#include "aibo_client/walk.h"

namespace aibo_client {

void checkRange(const std::string& name, long long value, long long lowest, long long highest, const char* unit = "");

void checkClientOptions(const ClientOptions& options);
void checkJointTargets(const std::vector<JointTarget>& targets, std::chrono::milliseconds duration);
/// @param joints may be empty
void checkJointsToHold(const std::vector<int>& joints);
void checkJointSpeedLimits(const std::vector<JointSpeedLimit>& limits);
void checkWalkVelocity(const WalkVelocity& velocity);
void checkLedCommands(const std::vector<LedCommand>& leds);
void checkColorTable(const ColorTable& table);

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_ARGUMENT_CHECKS_H
