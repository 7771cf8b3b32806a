/// @file command.h
#ifndef AIBO_DRIVER_COMMAND_LINE_COMMAND_H
#define AIBO_DRIVER_COMMAND_LINE_COMMAND_H

#include <boost/program_options.hpp>
#include <cstddef>
#include <string>
#include <vector>

#include "aibo_client/exceptions.h"
#include "command_line/output.h"
#include "command_line/robot.h"

namespace aibo_driver::command_line {

/// The exit status of the program. docs/command_line.md and the manual describe the values for scripts. After Ctrl-C it
/// is 128 + the signal.
enum ExitStatus {
  kDone = 0,
  kFailed = 1,       ///< the robot refused, or did not do what it was told; or a file could not be read or written
  kWrongUsage = 2,   ///< wrong arguments
  kUnreachable = 3,  ///< no connection to the robot, or it was lost
};

/// Thrown if the command was carried out but did not succeed.
class FailedException : public aibo_client::Exception {
 public:
  using Exception::Exception;
};

/// The words that the user typed behind the name of a command, and the options for all commands.
struct Arguments {
  RobotAddress robot;
  std::vector<std::string> words;                ///< the words that are not options
  boost::program_options::variables_map values;  ///< the command's own options

  bool has(const std::string& option) const { return values.count(option) > 0; }

  template <typename Value>
  const Value& get(const std::string& option) const {
    return values[option].as<Value>();
  }
};

struct Example {
  std::string arguments;  ///< the words behind "aibo "
  std::string effect;
};

/// A command. Help, manual, completion and the parser of arguments all use this description.
struct Command {
  std::string name;
  std::string synopsis;  ///< the command's words, such as "JOINT=ANGLE..."; empty if it has none
  std::string summary;   ///< a few words
  std::string details;   ///< whole sentences
  std::vector<Example> examples;
  std::size_t fewest_words = 0;
  std::size_t most_words = 0;
  std::vector<std::string> completions;  ///< completions of its words; "FILE" stands for files
  void (*add_options)(boost::program_options::options_description& options) = nullptr;  ///< null if it has no options
  ExitStatus (*run)(const Arguments& arguments, Output& output) = nullptr;

  /// The command's own options.
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
