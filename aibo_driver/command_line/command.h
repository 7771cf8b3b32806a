/// @file command.h
#ifndef AIBO_DRIVER_COMMAND_LINE_COMMAND_H
#define AIBO_DRIVER_COMMAND_LINE_COMMAND_H

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "command_line/output.h"
#include "command_line/robot.h"

namespace aibo_driver::command_line {

/// The exit status of the program. docs/command_line.md describes the values for scripts. After Ctrl-C it
/// is 128 + the signal.
enum ExitStatus {
  kDone = 0,
  kFailed = 1,       ///< the robot refused or failed, or a file could not be read or written
  kWrongUsage = 2,   ///< wrong arguments
  kUnreachable = 3,  ///< there is no connection to the robot, or it was lost
};

/// The words that the user typed after the name of a command, and the options for all commands.
struct Arguments {
  RobotAddress robot;
  std::vector<std::string> words;             ///< the words that are not options
  std::map<std::string, std::string> values;  ///< the options that were given or have a default, by their long names

  bool has(const std::string& option) const { return values.count(option) > 0; }

  /// @return the value as it was typed; empty if the option has neither a value nor a default
  std::string get(const std::string& option) const;

  /// @throw InvalidArgumentException the value is not a number from lowest to highest
  double number(const std::string& option, double lowest, double highest) const;

  /// @throw InvalidArgumentException the value is not a whole number from lowest to highest
  int wholeNumber(const std::string& option, int lowest, int highest) const;
};

/// An option of a command, or of all commands.
struct Option {
  std::string name;           ///< "seconds", or "output,o" if it has a letter, too
  std::string argument;       ///< what the help calls the option's value; empty if it takes no value
  std::string default_value;  ///< empty if the option has none
  std::string meaning;        ///< the meaning, for the help
};

struct Example {
  std::string arguments;  ///< the words after "aibo "
  std::string effect;
};

/// A command. The help and the parser of arguments both use this description.
struct Command {
  std::string name;
  /// The command's words, such as "FILE [NAME]" or "JOINT=ANGLE..."; empty if it has none. The parser allows as many
  /// words as it says: a word in brackets may be left out, and the last one may be repeated if it ends with three dots.
  std::string synopsis;
  std::string summary;  ///< the summary, a few words
  std::string details;  ///< the details, in whole sentences
  std::vector<Example> examples;
  std::function<ExitStatus(const Arguments& arguments, Output& output)> run;
  std::vector<Option> options = {};  ///< the command's own options
};

/// All commands, in the order of the help.
const std::vector<Command>& allCommands();

/// Finds a command by its name.
/// @throw InvalidArgumentException no command has this name; the message says how to list all commands
const Command& commandNamed(const std::string& name);

}  // namespace aibo_driver::command_line

#endif  // AIBO_DRIVER_COMMAND_LINE_COMMAND_H
