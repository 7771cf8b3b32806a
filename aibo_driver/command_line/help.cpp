#include "command_line/help.h"

#include <cstdio>
#include <sstream>

#include "aibo_client/exceptions.h"

namespace aibo_driver::command_line {
namespace {

namespace po = boost::program_options;

ExitStatus showHelp(const Arguments& arguments, Output& output) {
  if (arguments.words.empty()) {
    output.result(generalHelp(), Json::object({{"help", generalHelp()}}));
    return kDone;
  }
  const Command* const command = findCommand(arguments.words.front());
  if (command == nullptr) {
    throw aibo_client::InvalidArgumentException("there is no command '" + arguments.words.front() +
                                                "': `aibo help` lists them");
  }
  output.result(helpOf(*command), Json::object({{"help", helpOf(*command)}}));
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

po::options_description commonOptions() {
  po::options_description options("Options of all commands");
  options.add_options()("host", po::value<std::string>()->value_name("NAME"),
                        "the robot's name or address; the default is $AIBO_HOST, or else 127.0.0.1")(
      "port", po::value<std::string>()->default_value("54321")->value_name("N"), "its RCServer's port")(
      "timeout", po::value<std::string>()->default_value("5")->value_name("S"),
      "longest time to wait for the connection, 0.1 to 60")("json", "results for scripts, as JSON")(
      "help", "explains a command")("version", "shows the version of this program");
  return options;
}

std::string generalHelp() {
  std::string text =
      "usage: aibo [--host NAME] [--port N] [--json] COMMAND ...\n\n"
      "Talks to the RCServer of an Aibo, without ROS.\n\n";
  for (const Command& command : allCommands()) {
    char line[128];
    std::snprintf(line, sizeof line, "  %-11s %s\n", command.name.c_str(), command.summary.c_str());
    text += line;
  }
  std::ostringstream options;
  options << commonOptions();
  return text + "\n" + options.str() +
         "\n`aibo help COMMAND` explains a command, with examples.\n"
         "`source <(aibo completion)` lets bash complete them. `aibo manual | man -l -` is the manual.";
}

std::string helpOf(const Command& command) {
  std::string text = "usage: aibo " + command.name + (command.synopsis.empty() ? "" : " " + command.synopsis) + "\n\n" +
                     wrapped(command.name + ": " + command.summary + ". " + command.details) + "\n\nExamples:\n";
  for (const Example& example : command.examples) {
    char line[160];
    std::snprintf(line, sizeof line, "  aibo %-38s %s\n", example.arguments.c_str(), example.effect.c_str());
    text += line;
  }
  std::ostringstream options;
  if (command.add_options != nullptr) {
    options << "\n" << command.options();
  }
  options << "\n" << commonOptions();
  text += options.str();
  return text.substr(0, text.find_last_not_of('\n') + 1);
}

Command helpCommand() {
  Command command;
  command.name = "help";
  command.synopsis = "[COMMAND]";
  command.summary = "explains a command, or lists all";
  command.details = "It needs no robot.";
  command.examples = {{"help move", "explains how joints are moved"}};
  command.most_words = 1;
  command.run = showHelp;
  return command;
}

}  // namespace aibo_driver::command_line
