/// @file help.h
/// The program's help. It is made from the table of commands, as the parser is.
#ifndef AIBO_DRIVER_COMMAND_LINE_HELP_H
#define AIBO_DRIVER_COMMAND_LINE_HELP_H

#include <boost/program_options.hpp>
#include <string>
#include <vector>

#include "command_line/command.h"

namespace aibo_driver::command_line {

/// The options that are common to all commands.
const std::vector<Option>& commonOptions();

/// The options in the form in which Boost parses and prints them.
/// @param title the line above the options in the help
boost::program_options::options_description describe(const std::string& title, const std::vector<Option>& options);

/// Lists all commands, one in a line.
std::string generalHelp();

/// Describes one command in full.
std::string helpOf(const Command& command);

std::vector<Command> helpCommands();  ///< help

}  // namespace aibo_driver::command_line

#endif  // AIBO_DRIVER_COMMAND_LINE_HELP_H
