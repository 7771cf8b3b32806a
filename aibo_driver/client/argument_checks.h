/// @file argument_checks.h
/// Checks what RcServerClient is given. Every function throws InvalidArgumentException if a value is not allowed; the
/// message names the value and its range.
#ifndef AIBO_DRIVER_CLIENT_ARGUMENT_CHECKS_H
#define AIBO_DRIVER_CLIENT_ARGUMENT_CHECKS_H

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "aibo_driver/rcserver_client.h"

namespace aibo_driver {

void checkRange(const std::string& name, long long value, long long lowest, long long highest, const char* unit = "");

void checkClientOptions(const ClientOptions& options);
void checkJointTargets(const std::vector<JointTarget>& targets, std::chrono::milliseconds duration);
/// @param joints may be empty
void checkJointsToHold(const std::vector<int>& joints);
void checkJointSpeedLimits(const std::vector<JointSpeedLimit>& limits);
void checkWalkVelocity(const WalkVelocity& velocity);
void checkLedCommands(const std::vector<LedCommand>& leds);
void checkColorTable(const ColorTable& table);
void checkMotionContent(const std::vector<std::uint8_t>& content);

/// @return the name as it is sent: in capitals
std::string checkedMotionName(const std::string& name);

/// @return the name as it is sent: in capitals
std::string checkedPictureName(const std::string& name);

/// Like checkedMotionName(), for a file that is stored; see protocol::problemOfNewMotionName().
std::string checkedNewMotionName(const std::string& name);

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_ARGUMENT_CHECKS_H
