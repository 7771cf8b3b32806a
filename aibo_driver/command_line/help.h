/// @file help.h
/// The program's help, manual and completion. All of them are made from the table of commands, so they cannot differ.
#ifndef AIBO_DRIVER_COMMAND_LINE_HELP_H
#define AIBO_DRIVER_COMMAND_LINE_HELP_H

#include <string>

#include "command_line/command.h"

namespace aibo_driver::command_line {

/// The options that are common to all commands.
boost::program_options::options_description commonOptions();

/// Lists all commands, one in a line.
std::string generalHelp();

/// Describes one command in full.
std::string helpOf(const Command& command);

Command helpCommand();        ///< help [COMMAND]
Command manualCommand();      ///< manual: the manual page (roff)
Command completionCommand();  ///< completion: a script for bash

}  // namespace aibo_driver::command_line

#endif  // AIBO_DRIVER_COMMAND_LINE_HELP_H
