/// @file commands.h
/// The commands that talk to a robot. command.h says what a command is.
#ifndef AIBO_DRIVER_COMMAND_LINE_COMMANDS_COMMANDS_H
#define AIBO_DRIVER_COMMAND_LINE_COMMANDS_COMMANDS_H

#include "command_line/command.h"

namespace aibo_driver::command_line {

// doctor.cpp
Command doctorCommand();

// camera.cpp
Command pictureCommand();
Command watchCommand();

// joints.cpp
Command jointsCommand();
Command moveCommand();

// legs.cpp
Command walkCommand();
Command standCommand();
Command sitCommand();
Command restCommand();

// motions.cpp
Command motionsCommand();
Command playCommand();
Command uploadCommand();

// memory_stick.cpp
Command snapCommand();
Command picturesCommand();
Command fetchCommand();
Command deleteCommand();

// sound.cpp
Command listenCommand();
Command playSoundCommand();
Command sayCommand();

// power.cpp
Command motorsCommand();
Command stopCommand();

// body.cpp
Command sensorsCommand();
Command batteryCommand();

}  // namespace aibo_driver::command_line

#endif  // AIBO_DRIVER_COMMAND_LINE_COMMANDS_COMMANDS_H
