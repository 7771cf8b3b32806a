/// @file ends.h
#ifndef AIBO_DRIVER_COMMAND_LINE_COMMANDS_ENDS_H
#define AIBO_DRIVER_COMMAND_LINE_COMMANDS_ENDS_H

#include <optional>
#include <string>

#include "command_line/robot.h"

namespace aibo_driver::command_line {

/// Waits until the robot reports the end of the command's order (Robot::kOrder).
/// @param name what was ordered, for messages
/// @param seconds the longest time to wait
/// @return what the robot has said about its end, usually nothing; none if it has not ended within this time
/// @throw FailedException it ended in another way; the message says so
/// @throw NetworkException, Interrupted for the reasons of Robot::waitUntil()
std::optional<std::string> waitForEnd(Robot& robot, const std::string& name, double seconds);

/// True if the command's order has ended.
bool hasEnded(const Received& received);

}  // namespace aibo_driver::command_line

#endif  // AIBO_DRIVER_COMMAND_LINE_COMMANDS_ENDS_H
