#include "simulator/ers7/console_commands.h"

#include <OPENR/OUnits.h>

#include <cmath>
#include <iomanip>
#include <map>
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
    "lift on|off       lifts the robot from the floor, or sets it down\n"
    "lie SIDE          lets it fall on its left, right or back, or puts it back on its feet\n"
    "stick STATE       makes the memory stick ready, full, locked, out or slow\n"
    "hear FILE         lets its microphones hear a WAV file of 16 kHz, or silence\n"
    "joint NAME        shows where a joint really is, in degrees: head_pan...\n"
    "light NAME        shows the intensity of an LED, 0 to 255: face_1...\n"
    "ear NAME          shows whether the magnet draws an ear: left_ear, right_ear\n"
    "where             shows where the robot really is: x and y in metres, yaw in radian\n"
    "help              prints this list\n";

std::vector<std::string> wordsOf(const std::string& line) {
  std::istringstream text(line);
  std::vector<std::string> words;
  for (std::string word; text >> word;) {
    words.push_back(word);
  }
  return words;
}

/// @throw std::invalid_argument the text is not a number from 0 to 100
double percent(const std::string& text) {
  std::istringstream stream(text);
  double value = -1;
  if (!(stream >> value) || !stream.eof() || !(value >= 0 && value <= 100)) {
    throw std::invalid_argument("battery PERCENT: a number from 0 to 100, not \"" + text + "\"");
  }
  return value;
}

/// @throw std::invalid_argument the text is neither "on" nor "off"
bool isOn(const std::string& text) {
  if (text != "on" && text != "off") {
    throw std::invalid_argument("lift on or lift off, not lift \"" + text + "\"");
  }
  return text == "on";
}

/// @throw std::invalid_argument there is no such side
Side sideNamed(const std::string& text) {
  static const std::map<std::string, Side> kSides = {
      {"feet", Side::kFeet}, {"left", Side::kLeft}, {"right", Side::kRight}, {"back", Side::kBack}};
  const auto side = kSides.find(text);
  if (side == kSides.end()) {
    throw std::invalid_argument("lie left, right, back or feet, not lie \"" + text + "\"");
  }
  return side->second;
}

/// @throw std::invalid_argument there is no such state
StickState stickStateNamed(const std::string& text) {
  static const std::map<std::string, StickState> kStates = {{"ready", StickState::kReady},
                                                            {"full", StickState::kFull},
                                                            {"locked", StickState::kLocked},
                                                            {"out", StickState::kOut},
                                                            {"slow", StickState::kSlow}};
  const auto state = kStates.find(text);
  if (state == kStates.end()) {
    throw std::invalid_argument("stick ready, full, locked, out or slow, not stick \"" + text + "\"");
  }
  return state->second;
}

/// @return false if there is no such command
bool obey(SimulatedErs7& robot, const std::string& command, const std::string& object) {
  if (command == "press" || command == "release") {
    robot.press(object, command == "press");
  } else if (command == "jam" || command == "free") {
    robot.jam(object, command == "jam");
  } else if (command == "battery") {
    robot.setCharge(percent(object) / 100);
  } else if (command == "lift") {
    robot.lift(isOn(object));
  } else if (command == "lie") {
    robot.lie(sideNamed(object));
  } else if (command == "stick") {
    robot.stick().set(stickStateNamed(object));
  } else if (command == "hear") {
    robot.hear(object);
  } else {
    return false;
  }
  return true;
}

/// Writes a place as in "0.1234 -0.0450 1.5708".
std::string toText(const Place& place) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(4) << place.x << " " << place.y << " "
       << std::remainder(place.yaw, 2 * std::acos(-1.0));
  return text.str();
}

/// The answer to a question about a part; nothing if there is no such question.
std::optional<std::string> tell(const SimulatedErs7& robot, const std::string& question, const std::string& part) {
  std::ostringstream text;
  text << "ok: " << question << " " << part << " ";
  if (question == "joint") {
    text << std::fixed << std::setprecision(2) << degrees(robot.joints().named(part).position() / 1e6);
  } else if (question == "light") {
    text << robot.led(part).intensity;
  } else if (question == "ear") {
    text << (robot.ear(part).isDrawn() ? "drawn" : "let go");
  } else {
    return std::nullopt;
  }
  return text.str() + "\n";
}

}  // namespace

std::optional<std::string> obeyConsole(SimulatedErs7& robot, const std::string& line) {
  const auto words = wordsOf(line);
  if (words.size() == 1 && words[0] == "help") {
    return kHelp;
  }
  if (words.size() == 1 && words[0] == "where") {
    return "ok: where " + toText(robot.pose()) + "\n";
  }
  try {
    const auto told = words.size() == 2 ? tell(robot, words[0], words[1]) : std::nullopt;
    if (told) {
      return told;
    }
    if (words.size() == 2 && obey(robot, words[0], words[1])) {
      return "ok: " + words[0] + " " + words[1] + "\n";
    }
  } catch (const std::invalid_argument& error) {
    return std::string("error: ") + error.what() + "\n";
  } catch (const SoundError& error) {
    return std::string("error: ") + error.what() + "\n";
  }
  return std::nullopt;
}

}  // namespace simulated_ers7
