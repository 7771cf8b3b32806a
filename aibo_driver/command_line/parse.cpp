#include "command_line/parse.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <sstream>

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
    const std::vector<Option>& options = commonOptions();
    const bool takes_next = std::any_of(options.begin(), options.end(), [&](const Option& option) {
      return words[at] == "--" + option.name && !option.argument.empty();
    });
    at += takes_next ? 2 : 1;
  }
  return std::min(at, words.size());
}

/// Checks the number of words against the synopsis.
void checkNumberOfWords(const Command& command, std::size_t number) {
  std::size_t fewest = 0;
  std::size_t most = 0;
  std::istringstream synopsis(command.synopsis);
  for (std::string word; synopsis >> word;) {
    fewest += word.front() == '[' ? 0 : 1;
    const bool repeats = word.size() > 3 && word.compare(word.size() - 3, 3, "...") == 0;
    most = repeats ? std::numeric_limits<std::size_t>::max() : most + 1;
  }
  if (number < fewest || number > most) {
    throw InvalidArgumentException("usage: aibo " + command.name +
                                   (command.synopsis.empty() ? "" : " " + command.synopsis) + " (`aibo help " +
                                   command.name + "` has examples)");
  }
}

RobotAddress addressIn(const Arguments& arguments) {
  RobotAddress address;
  const char* const environment = std::getenv("AIBO_HOST");
  if (arguments.has("host")) {
    address.host = arguments.get("host");
    address.host_is_given = true;
  } else if (environment != nullptr && *environment != '\0') {
    address.host = environment;
    address.host_is_given = true;
  }
  address.port = arguments.wholeNumber("port", 1, 65535);
  const double timeout = arguments.number("timeout", 0.1, kLongestTimeout);
  address.timeout = std::chrono::duration_cast<std::chrono::milliseconds>(nanosecondsOf(timeout));
  return address;
}

/// Sorts the words after a command into options and others.
/// @throw InvalidArgumentException an option is not among `options`, or lacks its value
void sortInto(const std::vector<std::string>& words, const std::vector<Option>& options, Arguments* arguments) {
  po::options_description all = describe("", options);
  all.add_options()("word", po::value<std::vector<std::string>>());
  const po::positional_options_description positional = po::positional_options_description().add("word", -1);
  po::variables_map values;
  try {
    po::store(po::command_line_parser(words).options(all).positional(positional).style(kStyle).run(), values);
  } catch (const po::error& error) {
    throw InvalidArgumentException(error.what() + std::string(" (`aibo help` lists commands and options)"));
  }
  for (const auto& [name, value] : values) {
    if (name == "word") {
      arguments->words = value.as<std::vector<std::string>>();
    } else {
      arguments->values[name] = value.as<std::string>();
    }
  }
}

}  // namespace

bool wantsJson(const std::vector<std::string>& words) {
  return std::find(words.begin(), words.end(), "--json") != words.end();
}

CommandLine parse(const std::vector<std::string>& words) {
  CommandLine line;
  const std::size_t at = positionOfCommand(words);
  std::vector<Option> options = commonOptions();
  std::vector<std::string> rest = words;
  if (at < words.size()) {
    line.command = &commandNamed(words[at]);
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(at));
    options.insert(options.begin(), line.command->options.begin(), line.command->options.end());
  }
  sortInto(rest, options, &line.arguments);
  line.help = line.arguments.has("help");
  line.version = line.arguments.has("version");
  line.arguments.robot = addressIn(line.arguments);
  if (line.command == nullptr && !line.help && !line.version) {
    throw InvalidArgumentException("usage: aibo COMMAND (`aibo help` lists the commands)");
  }
  if (line.command != nullptr && !line.help && !line.version) {
    checkNumberOfWords(*line.command, line.arguments.words.size());
  }
  return line;
}

}  // namespace aibo_driver::command_line
