/// @file parse.h
#ifndef AIBO_DRIVER_COMMAND_LINE_PARSE_H
#define AIBO_DRIVER_COMMAND_LINE_PARSE_H

#include <string>
#include <vector>

#include "command_line/command.h"

namespace aibo_driver::command_line {

/// The parsed command line.
struct CommandLine {
  const Command* command = nullptr;  ///< null if there is no command, only --help or --version
  Arguments arguments;
  bool help = false;
  bool version = false;
};

/// True if --json is among the words, even if other words are wrong, so that the error is a JSON document, too.
bool wantsJson(const std::vector<std::string>& words);

/// Parses the words. The first word that is no option is the command. The command's own options and the common ones may
/// be anywhere after it.
/// @param words the words without the program's name
/// @throw InvalidArgumentException something is wrong; the message says what
CommandLine parse(const std::vector<std::string>& words);

}  // namespace aibo_driver::command_line

#endif  // AIBO_DRIVER_COMMAND_LINE_PARSE_H
