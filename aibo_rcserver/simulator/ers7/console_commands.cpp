#include "simulator/ers7/console_commands.h"

#include <sstream>
#include <stdexcept>
#include <vector>

namespace simulated_ers7 {
namespace {

const char kHelp[] =
    "press BUTTON      presses the pause button or a switch, or touches a touch sensor: pause, chin, head_touch...\n"
    "release BUTTON    releases it\n"
    "battery PERCENT   sets the remaining charge\n"
    "jam JOINT         blocks a joint: head_pan...\n"
    "free JOINT        unblocks it\n"
    "help              prints this list\n";

std::vector<std::string> wordsOf(const std::string& line) {
  std::istringstream text(line);
  std::vector<std::string> words;
  for (std::string word; text >> word;) {
    words.push_back(word);
  }
  return words;
}

/// @throw std::invalid_argument unless `text` is a number from 0 to 100
double percent(const std::string& text) {
  std::istringstream stream(text);
  double value = -1;
  if (!(stream >> value) || !stream.eof() || !(value >= 0 && value <= 100)) {
    throw std::invalid_argument("battery PERCENT: a number from 0 to 100, not \"" + text + "\"");
  }
  return value;
}

/// @return false if there is no such command
bool obey(SimulatedErs7& robot, const std::string& command, const std::string& object) {
  if (command == "press" || command == "release") {
    robot.press(object, command == "press");
  } else if (command == "jam" || command == "free") {
    robot.jam(object, command == "jam");
  } else if (command == "battery") {
    robot.setCharge(percent(object) / 100);
  } else {
    return false;
  }
  return true;
}

}  // namespace

std::string obeyConsole(SimulatedErs7& robot, const std::string& line) {
  const auto words = wordsOf(line);
  if (words.empty()) {
    return "";
  }
  if (words[0] == "help") {
    return kHelp;
  }
  try {
    if (words.size() == 2 && obey(robot, words[0], words[1])) {
      return "ok: " + words[0] + " " + words[1] + "\n";
    }
  } catch (const std::invalid_argument& error) {
    return std::string("error: ") + error.what() + "\n";
  }
  return "error: not understood: \"" + line + "\"; the commands are\n" + kHelp;
}

}  // namespace simulated_ers7
