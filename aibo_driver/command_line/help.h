/// @file help.h
/// What the program says about itself. Help, manual and completion are all made from the table of commands, so they
/// cannot differ.
#ifndef AIBO_DRIVER_COMMAND_LINE_HELP_H
#define AIBO_DRIVER_COMMAND_LINE_HELP_H

#include <string>

#include "command_line/command.h"

namespace aibo_driver::command_line {

/// The options that all commands have.
boost::program_options::options_description commonOptions();

/// All commands, one line each.
std::string generalHelp();

/// Everything about one command.
std::string helpOf(const Command& command);

Command helpCommand();        ///< help [COMMAND]
Command manualCommand();      ///< manual: the manual page (roff)
Command completionCommand();  ///< completion: a script for bash

}  // namespace aibo_driver::command_line

#endif  // AIBO_DRIVER_COMMAND_LINE_HELP_H
