#include "command_line/parse.h"

#include <algorithm>
#include <cstdlib>

#include "aibo_client/exceptions.h"
#include "command_line/help.h"
#include "command_line/quantities.h"

namespace aibo_driver::command_line {

using aibo_client::InvalidArgumentException;

namespace {

namespace po = boost::program_options;

// Options cannot be shortened, because a script would break if another option with the same beginning were added.
constexpr int kStyle = po::command_line_style::default_style & ~po::command_line_style::allow_guessing;

constexpr double kLongestTimeout = 60;  // s

/// @return the position of the command; the number of words if there is none
std::size_t positionOfCommand(const std::vector<std::string>& words) {
  std::size_t at = 0;
  while (at < words.size() && words[at].rfind('-', 0) == 0) {
    const bool takes_next = words[at] == "--host" || words[at] == "--port" || words[at] == "--timeout";
    at += takes_next ? 2 : 1;
  }
  return std::min(at, words.size());
}

const Command& commandNamed(const std::string& name) {
  const Command* const command = findCommand(name);
  if (command == nullptr) {
    throw InvalidArgumentException("there is no command '" + name + "': `aibo help` lists them");
  }
  return *command;
}

void checkNumberOfWords(const Command& command, std::size_t number) {
  if (number < command.fewest_words || number > command.most_words) {
    throw InvalidArgumentException("usage: aibo " + command.name +
                                   (command.synopsis.empty() ? "" : " " + command.synopsis) + " (`aibo help " +
                                   command.name + "` has examples)");
  }
}

RobotAddress addressIn(const po::variables_map& values) {
  RobotAddress address;
  const char* const environment = std::getenv("AIBO_HOST");
  if (values.count("host") > 0) {
    address.host = values["host"].as<std::string>();
    address.host_is_given = true;
  } else if (environment != nullptr && *environment != '\0') {
    address.host = environment;
    address.host_is_given = true;
  }
  address.port = parseWholeNumber("--port", values["port"].as<std::string>(), 1, 65535);
  const double timeout = parseNumber("--timeout", values["timeout"].as<std::string>(), 0.1, kLongestTimeout);
  address.timeout = std::chrono::duration_cast<std::chrono::milliseconds>(nanosecondsOf(timeout));
  return address;
}

}  // namespace

bool wantsJson(const std::vector<std::string>& words) {
  return std::find(words.begin(), words.end(), "--json") != words.end();
}

CommandLine parse(const std::vector<std::string>& words) {
  CommandLine line;
  const std::size_t at = positionOfCommand(words);
  po::options_description options = commonOptions();
  std::vector<std::string> rest = words;
  if (at < words.size()) {
    line.command = &commandNamed(words[at]);
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(at));
    options.add(line.command->options());
  }
  po::options_description all;
  all.add(options).add_options()("word", po::value<std::vector<std::string>>());
  const po::positional_options_description positional = po::positional_options_description().add("word", -1);
  po::variables_map& values = line.arguments.values;
  po::store(po::command_line_parser(rest).options(all).positional(positional).style(kStyle).run(), values);
  po::notify(values);
  line.json = values.count("json") > 0;
  line.help = values.count("help") > 0;
  line.version = values.count("version") > 0;
  if (values.count("word") > 0) {
    line.arguments.words = values["word"].as<std::vector<std::string>>();
  }
  line.arguments.robot = addressIn(values);
  if (line.command == nullptr && !line.help && !line.version) {
    throw InvalidArgumentException("usage: aibo COMMAND (`aibo help` lists the commands)");
  }
  if (line.command != nullptr && !line.help && !line.version) {
    checkNumberOfWords(*line.command, line.arguments.words.size());
  }
  return line;
}

}  // namespace aibo_driver::command_line
