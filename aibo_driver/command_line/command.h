/// @file command.h
#ifndef AIBO_DRIVER_COMMAND_LINE_COMMAND_H
#define AIBO_DRIVER_COMMAND_LINE_COMMAND_H

#include <boost/program_options.hpp>
#include <cstddef>
#include <string>
#include <vector>

#include "aibo_driver/exceptions.h"
#include "command_line/output.h"
#include "command_line/robot.h"

namespace aibo_driver::command_line {

/// How the program ends. docs/command_line.md and the manual describe them for scripts. Ctrl-C: 128 + the signal.
enum ExitStatus {
  kDone = 0,
  kFailed = 1,       ///< the robot refused, or did not do what it was told; a file could not be read or written
  kWrongUsage = 2,   ///< wrong arguments
  kUnreachable = 3,  ///< no connection to the robot, or it was lost
};

/// The command was carried out and did not succeed.
class FailedException : public Exception {
 public:
  using Exception::Exception;
};

/// What the user typed behind the name of a command, and the options for all commands.
struct Arguments {
  RobotAddress robot;
  std::vector<std::string> words;                ///< those that are not options
  boost::program_options::variables_map values;  ///< the command's own options

  bool has(const std::string& option) const { return values.count(option) > 0; }

  template <typename Value>
  const Value& get(const std::string& option) const {
    return values[option].as<Value>();
  }
};

struct Example {
  std::string arguments;  ///< behind "aibo "
  std::string effect;
};

/// A command: help, manual, completion and the parser of arguments all use this description.
struct Command {
  std::string name;
  std::string synopsis;  ///< its words, such as "JOINT=ANGLE..."; empty if it has none
  std::string summary;   ///< a few words
  std::string details;   ///< sentences
  std::vector<Example> examples;
  std::size_t fewest_words = 0;
  std::size_t most_words = 0;
  std::vector<std::string> completions;  ///< of its words; "FILE" stands for files
  void (*add_options)(boost::program_options::options_description& options) = nullptr;  ///< null: it has none
  ExitStatus (*run)(const Arguments& arguments, Output& output) = nullptr;

  /// Its own options.
  boost::program_options::options_description options() const {
    boost::program_options::options_description options("Options of " + name);
    if (add_options != nullptr) {
      add_options(options);
    }
    return options;
  }
};

/// All commands, in the order of the help.
const std::vector<Command>& allCommands();

/// The command with this name, or null.
const Command* findCommand(const std::string& name);

}  // namespace aibo_driver::command_line

#endif  // AIBO_DRIVER_COMMAND_LINE_COMMAND_H
