/// @file parse.h
#ifndef AIBO_DRIVER_COMMAND_LINE_PARSE_H
#define AIBO_DRIVER_COMMAND_LINE_PARSE_H

#include <string>
#include <vector>

#include "command_line/command.h"

namespace aibo_driver::command_line {

/// What was typed.
struct CommandLine {
  const Command* command = nullptr;  ///< null: none, for --help and --version alone
  Arguments arguments;
  bool json = false;
  bool help = false;
  bool version = false;
};

/// True if --json is among the words, also if others among them are wrong: then the error is a document, too.
bool wantsJson(const std::vector<std::string>& words);

/// The first word that is no option is the command. Its options, and those of all commands, may be anywhere behind it.
/// @param words without the program's name
/// @throw InvalidArgumentException, boost::program_options::error something is wrong; the message says what
CommandLine parse(const std::vector<std::string>& words);

}  // namespace aibo_driver::command_line

#endif  // AIBO_DRIVER_COMMAND_LINE_PARSE_H
