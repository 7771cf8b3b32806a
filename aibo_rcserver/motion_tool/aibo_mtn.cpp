// Makes motion files from their text form, and prints motion files in it (docs/motions.md).
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "motion_tool/motion_tool.h"

namespace {

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

const char kUsage[] =
    "usage: aibo_mtn TEXT MOTION.MTN   make a motion file from its text form\n"
    "       aibo_mtn MOTION.MTN        print the text form of a motion file\n";

std::string readFile(const std::string& name) {
  std::ifstream file(name, std::ios::binary);
  std::string content((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file) {
    throw std::runtime_error(name + " cannot be read");
  }
  return content;
}

void writeFile(const std::string& name, const std::string& content) {
  std::ofstream file(name, std::ios::binary);
  if (!file.write(content.data(), static_cast<std::streamsize>(content.size())).flush()) {
    throw std::runtime_error(name + " cannot be written");
  }
}

void read(const std::string& bytes, const std::string& file, mtn::Motion& motion) {
  if (!motion.read(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size())) {
    throw std::runtime_error(file + " is not a motion file: " + motion.problem());
  }
}

// Names what the robot cannot do exactly. That may be intended, so it does not stop the author.
void warn(const mtn::Motion& motion) {
  const robot_model::RobotModel* robot = motion_tool::modelOf(motion.design());
  if (robot == nullptr) {
    std::cerr << "aibo_mtn: not checked: there is no robot with the design \""
              << motion_tool::forTerminal(motion.design()) << "\"\n";
    return;
  }
  for (const std::string& obstacle : motion_tool::findObstacles(motion, *robot)) {
    std::cerr << "aibo_mtn: " << motion_tool::forTerminal(obstacle) << '\n';
  }
}

// The text with `prefix` before each line, as it may go to a terminal.
std::string eachLineAfter(const std::string& prefix, const std::string& text) {
  std::string result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    result += prefix + motion_tool::forTerminal(line) + '\n';
  }
  return result;
}

void make(const std::string& source, const std::string& target) {
  std::ifstream text(source);
  if (!text) {
    throw std::runtime_error(source + " cannot be read");
  }
  std::string bytes;
  try {
    bytes = motion_tool::encodeMtn(motion_tool::parseTextForm(text));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(eachLineAfter(source + ": ", error.what()));
  }
  mtn::Motion motion;
  read(bytes, target, motion);
  warn(motion);
  writeFile(target, bytes);
}

void print(const std::string& source) {
  const std::string bytes = readFile(source);
  mtn::Motion motion;
  read(bytes, source, motion);
  std::cout << motion_tool::printTextForm(motion);
  warn(motion);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.empty() || arguments.size() > 2 || arguments[0] == "--help") {
    const bool is_help = arguments.size() == 1;
    (is_help ? std::cout : std::cerr) << kUsage;
    return is_help ? 0 : kWrongUsage;
  }
  try {
    if (arguments.size() == 2) {
      make(arguments[0], arguments[1]);
    } else {
      print(arguments[0]);
    }
  } catch (const std::exception& error) {
    std::cerr << eachLineAfter("aibo_mtn: ", error.what());
    return kFailed;
  }
  return 0;
}
