/// @file commands.h
/// The commands that talk to a robot, a function for each source file, and what several of them print. command.h says
/// what a command is.
#ifndef AIBO_DRIVER_COMMAND_LINE_COMMANDS_COMMANDS_H
#define AIBO_DRIVER_COMMAND_LINE_COMMANDS_COMMANDS_H

#include <string>
#include <vector>

#include "camera/link_meter.h"
#include "command_line/command.h"

namespace aibo_driver::command_line {

std::vector<Command> bodyCommands();    ///< sensors
std::vector<Command> cameraCommands();  ///< picture, watch
std::vector<Command> doctorCommands();  ///< doctor
std::vector<Command> jointCommands();   ///< joints, move
std::vector<Command> legCommands();     ///< walk, stand, sit, rest
std::vector<Command> motionCommands();  ///< motions, play, upload, delete
std::vector<Command> powerCommands();   ///< motors, stop
std::vector<Command> soundCommands();   ///< listen, play-sound, say

/// Describes how pictures come in one line: pictures a second, data rate, age, loss.
std::string wordsOf(const camera::LinkMeter::Reading& reading);

Json jsonOf(const camera::LinkMeter::Reading& reading);

}  // namespace aibo_driver::command_line

#endif  // AIBO_DRIVER_COMMAND_LINE_COMMANDS_COMMANDS_H
