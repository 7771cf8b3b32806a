/// @file ends.h
#ifndef AIBO_DRIVER_COMMAND_LINE_COMMANDS_ENDS_H
#define AIBO_DRIVER_COMMAND_LINE_COMMANDS_ENDS_H

#include <string>

#include "aibo_driver/motion_end.h"
#include "command_line/robot.h"

namespace aibo_driver::command_line {

/// Waits until the robot says that it has done something to its end.
/// @param name as in MotionEnd; empty: any
/// @param seconds longest time to wait
/// @return false if it has not ended in this time
/// @throw FailedException it ended in another way; the message says so
/// @throw NetworkException, Interrupted as Robot::waitUntil()
bool waitForEnd(Robot& robot, EndedKind kind, const std::string& name, double seconds);

}  // namespace aibo_driver::command_line

#endif  // AIBO_DRIVER_COMMAND_LINE_COMMANDS_ENDS_H
