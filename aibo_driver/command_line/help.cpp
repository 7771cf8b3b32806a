#include "command_line/help.h"

#include <cstdio>
#include <sstream>

namespace aibo_driver::command_line {
namespace {

namespace po = boost::program_options;

constexpr const char* kCommonTitle = "Options of all commands";

ExitStatus showHelp(const Arguments& arguments, Output& output) {
  const std::string help = arguments.words.empty() ? generalHelp() : helpOf(commandNamed(arguments.words.front()));
  output.result(help, Json::object({{"help", help}}));
  return kDone;
}

/// Breaks a text into lines of at most 80 characters.
std::string wrapped(const std::string& text) {
  constexpr std::size_t kWidth = 80;
  std::istringstream words(text);
  std::string lines;
  std::size_t column = 0;
  for (std::string word; words >> word; column += word.size()) {
    const bool fits = column > 0 && column + 1 + word.size() <= kWidth;
    lines += column == 0 ? "" : fits ? " " : "\n";
    column = fits ? column + 1 : 0;
    lines += word;
  }
  return lines;
}

}  // namespace

const std::vector<Option>& commonOptions() {
  static const std::vector<Option> options = {
      {"host", "NAME", "", "the robot's name or address; the default is $AIBO_HOST, or else 127.0.0.1"},
      {"port", "N", "54321", "its RCServer's port"},
      {"timeout", "S", "5", "longest time to wait for the connection, 0.1 to 60"},
      {"json", "", "", "results for scripts, as JSON"},
      {"help,h", "", "", "explains a command"},
      {"version", "", "", "shows the version of this program"}};
  return options;
}

po::options_description describe(const std::string& title, const std::vector<Option>& options) {
  po::options_description description(title);
  for (const Option& option : options) {
    if (option.argument.empty()) {
      description.add_options()(option.name.c_str(), option.meaning.c_str());
      continue;
    }
    auto* const value = po::value<std::string>()->value_name(option.argument);
    if (!option.default_value.empty()) {
      value->default_value(option.default_value);
    }
    description.add_options()(option.name.c_str(), value, option.meaning.c_str());
  }
  return description;
}

std::string generalHelp() {
  std::string text =
      "usage: aibo [--host NAME] [--port N] [--json] COMMAND ...\n\nTalks to the RCServer of an Aibo, without ROS.\n\n";
  for (const Command& command : allCommands()) {
    char line[128];
    std::snprintf(line, sizeof line, "  %-11s %s\n", command.name.c_str(), command.summary.c_str());
    text += line;
  }
  std::ostringstream options;
  options << describe(kCommonTitle, commonOptions());
  return text + "\n" + options.str() + "\n`aibo help COMMAND` explains a command, with examples.";
}

std::string helpOf(const Command& command) {
  std::string text = "usage: aibo " + command.name + (command.synopsis.empty() ? "" : " " + command.synopsis) + "\n\n" +
                     wrapped(command.name + ": " + command.summary + ". " + command.details) + "\n\nExamples:\n";
  for (const Example& example : command.examples) {
    char line[160];
    std::snprintf(line, sizeof line, "  aibo %-37s  %s\n", example.arguments.c_str(), example.effect.c_str());
    text += line;
  }
  std::ostringstream options;
  if (!command.options.empty()) {
    options << "\n" << describe("Options of " + command.name, command.options);
  }
  options << "\n" << describe(kCommonTitle, commonOptions());
  text += options.str();
  return text.substr(0, text.find_last_not_of('\n') + 1);
}

std::vector<Command> helpCommands() {
  return {{"help",
           "[COMMAND]",
           "explains a command, or lists all",
           "It needs no robot.",
           {{"help move", "explains how joints are moved"}},
           showHelp}};
}

}  // namespace aibo_driver::command_line
