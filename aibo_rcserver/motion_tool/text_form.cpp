#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>

#include "motion_tool/motion_tool.h"
#include "protocol/text.h"

namespace motion_tool {

using robot_model::RobotModel;

namespace {

constexpr double kMicroradiansPerDegree = 1e6 * 3.14159265358979323846 / 180;

// The name of a robot in Sony's motion files. An unknown name is returned unchanged.
std::string designOf(const std::string& robot) {
  return robot == "ERS-7" ? "DRX-1000" : robot == "ERS-210" ? "DRX-910" : robot;
}

bool isEar(const RobotModel* robot, const std::string& locator) {
  return robot != nullptr && findEarByLocator(*robot, locator.c_str()) != robot_model::NO_EAR;
}

template <typename Number>
Number parseNumber(const std::string& word, const char* what) {
  std::istringstream stream(word);
  Number number{};
  if (!(stream >> number) || !stream.eof()) {
    throw std::runtime_error("\"" + word + "\" is not a number of " + what);
  }
  return number;
}

std::string restOf(std::istream& line) {
  std::string text;
  std::getline(line >> std::ws, text);
  text.erase(text.find_last_not_of(" \t\r") + 1);
  return text;
}

// Parses a text. It goes on after a mistake, so that one run reports all mistakes.
class Parser {
 public:
  KeyFrameMotion parse(std::istream& text) {
    for (std::string line; std::getline(text, line);) {
      ++line_number_;
      report([&] { parseLine(line.substr(0, line.find('#'))); });
    }
    if (motion_.key_frames.empty() && problems_.empty()) {
      throw std::runtime_error("there is no key frame: \"at 0\" begins the first one");
    }
    if (!problems_.empty()) {
      throw std::runtime_error(problems_);
    }
    return motion_;
  }

 private:
  // Calls a function, and records the mistake if it throws one.
  template <typename Function>
  void report(const Function& function) {
    try {
      function();
    } catch (const std::runtime_error& error) {
      problems_ += (problems_.empty() ? "line " : "\nline ") + std::to_string(line_number_) + ": " + error.what();
    }
  }

  void parseLine(const std::string& line) {
    std::istringstream words(line);
    std::string word;
    if (!(words >> word)) {
      return;
    }
    if (word == "name") {
      motion_.name = restOf(words);
    } else if (word == "creator") {
      motion_.creator = restOf(words);
    } else if (word == "robot") {
      const std::string name = restOf(words);
      robot_ = robot_model::findRobotModel(name.c_str());
      motion_.design = designOf(name);
    } else if (word == "frame") {
      parseFrame(restOf(words));
    } else if (word == "at") {
      beginKeyFrame(words);
      parsePositions(words);
    } else {
      std::istringstream positions(line);
      parsePositions(positions);
    }
  }

  void parseFrame(const std::string& word) {
    const int frame = parseNumber<int>(word, "milliseconds");
    if (frame < mtn::MIN_FRAME_MILLISECONDS || frame > mtn::MAX_FRAME_MILLISECONDS) {
      throw std::runtime_error("a frame of " + word + " ms is outside " + std::to_string(mtn::MIN_FRAME_MILLISECONDS) +
                               ".." + std::to_string(mtn::MAX_FRAME_MILLISECONDS) + " ms");
    }
    if (!motion_.key_frames.empty()) {
      throw std::runtime_error("\"frame\" comes before the first \"at\"");
    }
    motion_.frame_milliseconds = frame;
  }

  void beginKeyFrame(std::istream& words) {
    std::string time;
    words >> time;
    KeyFrame next;
    next.milliseconds = parseNumber<int>(time, "milliseconds");
    report([&] { checkTime(next.milliseconds); });
    if (!motion_.key_frames.empty()) {
      next.positions = motion_.key_frames.back().positions;
    }
    motion_.key_frames.push_back(next);
  }

  void checkTime(int milliseconds) const {
    const int frame = motion_.frame_milliseconds;
    if (motion_.key_frames.empty()) {
      if (milliseconds != 0) {
        throw std::runtime_error("the first key frame must be at 0 ms");
      }
    } else if (milliseconds <= motion_.key_frames.back().milliseconds) {
      throw std::runtime_error("the key frames are not in the order of their times");
    } else if (milliseconds % frame != 0) {
      const long long below = milliseconds - milliseconds % frame;
      throw std::runtime_error(std::to_string(milliseconds) + " ms is not a multiple of a frame, which has " +
                               std::to_string(frame) + " ms; " + std::to_string(below) + " and " +
                               std::to_string(below + frame) + " are");
    }
  }

  void parsePositions(std::istream& words) {
    std::string joint;
    while (words >> joint) {
      if (motion_.key_frames.empty()) {
        throw std::runtime_error("\"" + joint + "\" comes before the first \"at\"");
      }
      std::string degrees;
      if (!(words >> degrees)) {
        throw std::runtime_error(joint + " has no angle");
      }
      report([&] { parsePosition(joint, degrees); });
    }
  }

  void parsePosition(const std::string& joint, const std::string& degrees) {
    const std::string locator = locatorOf(joint);
    if (isEar(robot_, locator)) {
      setPosition(locator, joint, parseEar(joint, degrees));
      return;
    }
    const double microradians = parseNumber<double>(degrees, "degrees") * kMicroradiansPerDegree;
    if (!(std::abs(microradians) <= mtn::MAX_POSITION)) {
      throw std::runtime_error(joint + " is more than a turn away");
    }
    setPosition(locator, joint, static_cast<int>(std::lround(microradians)));
  }

  static int parseEar(const std::string& ear, const std::string& word) {
    const int value = parseNumber<int>(word, "states");
    if (value < -mtn::MAX_POSITION || value > mtn::MAX_POSITION) {
      throw std::runtime_error(ear + " has a state that does not fit into a motion: 0 and 1 are enough");
    }
    return value;
  }

  std::string locatorOf(const std::string& joint) const {
    if (joint.rfind("PRM:", 0) == 0) {
      return joint;
    }
    if (robot_ == nullptr) {
      throw std::runtime_error("which robot? \"robot ERS-7\" or \"robot ERS-210\" comes first");
    }
    const int ear = robot_model::findEarByName(*robot_, joint.c_str());
    if (ear != robot_model::NO_EAR) {
      return robot_->ears[ear].locator;
    }
    const int index = robot_model::findJointByName(*robot_, joint.c_str());
    if (index == robot_model::NO_JOINT) {
      throw std::runtime_error(std::string("an ") + robot_->design + " has no joint \"" + joint + "\"");
    }
    return robot_->joints[index].locator;
  }

  void setPosition(const std::string& locator, const std::string& joint, int position) {
    auto found = std::find(motion_.locators.begin(), motion_.locators.end(), locator);
    std::vector<int>& positions = motion_.key_frames.back().positions;
    if (found == motion_.locators.end()) {
      if (motion_.key_frames.size() > 1) {
        throw std::runtime_error(joint + " is not in the first key frame, which names all joints");
      }
      motion_.locators.push_back(locator);
      positions.push_back(position);
      return;
    }
    positions[static_cast<std::size_t>(found - motion_.locators.begin())] = position;
  }

  const RobotModel* robot_ = nullptr;
  KeyFrameMotion motion_;
  int line_number_ = 0;
  std::string problems_;
};

// Prints enough digits to restore the same number of microradians, without trailing zeros.
std::string degreesOf(int microradians) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.5f", microradians / kMicroradiansPerDegree);
  std::string digits(text);
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') {
    digits.pop_back();
  }
  return digits == "-0" ? "0" : digits;
}

// Makes the text safe, and replaces each '#', which would begin a comment.
std::string quoted(const std::string& text) {
  std::string result = forTerminal(text);
  std::replace(result.begin(), result.end(), '#', '?');
  return result;
}

// A joint with its angle, or an ear with its state.
std::string printed(const RobotModel* robot, const char* locator, int position) {
  if (isEar(robot, locator)) {
    return std::string(robot->ears[findEarByLocator(*robot, locator)].name) + ' ' + std::to_string(position);
  }
  const int joint = robot != nullptr ? findJointByLocator(*robot, locator) : robot_model::NO_JOINT;
  return std::string(joint == robot_model::NO_JOINT ? locator : robot->joints[joint].name) + ' ' + degreesOf(position);
}

}  // namespace

std::string forTerminal(std::string line) {
  if (!protocol::isPlainText(line.data(), line.size())) {
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  }
  return line;
}

KeyFrameMotion parseTextForm(const std::string& text) {
  const protocol::Text shown = protocol::textInFile(text.data(), text.size());
  std::istringstream lines(std::string(shown.begin, shown.size));
  return Parser().parse(lines);
}

std::string printTextForm(const mtn::Motion& motion) {
  const RobotModel* const robot = robotOf(motion);
  std::ostringstream text;
  text << "name " << quoted(motion.name()) << "\ncreator " << quoted(motion.creator()) << "\nrobot "
       << quoted(robot != nullptr ? robot->design : motion.design()) << "\nframe " << motion.frameMilliseconds()
       << '\n';
  int milliseconds = 0;
  for (int key_frame = 0; key_frame < motion.numberOfKeyFrames(); ++key_frame) {
    milliseconds += motion.milliseconds(key_frame);
    text << "\nat " << milliseconds << '\n';
    for (int joint = 0; joint < motion.numberOfJoints(); ++joint) {
      text << "  " << printed(robot, motion.locator(joint), motion.position(key_frame, joint)) << '\n';
    }
  }
  return text.str();
}

}  // namespace motion_tool
