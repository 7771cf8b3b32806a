/// @file aibo_mtn.cpp
/// Makes motion files of their readable form, and shows them in it (docs/motions.md).

#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "motion_tool/motion_check.h"
#include "motion_tool/mtn_writer.h"
#include "motion_tool/robots.h"
#include "motion_tool/text_form.h"
#include "mtn/motion.h"

namespace {

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

const char kUsage[] =
    "usage: aibo_mtn TEXT MOTION.MTN   make a motion file of its text form\n"
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
    throw std::runtime_error(file + " is no motion file: " + motion.problem());
  }
}

// What the robot would do otherwise than it is written is said; it is for the author to decide.
void warn(const mtn::Motion& motion) {
  const robot_model::RobotModel* robot = motion_tool::modelOf(motion.design());
  if (robot == nullptr) {
    std::cerr << "aibo_mtn: not checked for any robot: the design \"" << motion.design() << "\" is not known\n";
    return;
  }
  for (const std::string& obstacle : motion_tool::findObstacles(motion, *robot)) {
    std::cerr << "aibo_mtn: " << obstacle << '\n';
  }
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
    throw std::runtime_error(source + ": " + error.what());
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
    std::cerr << "aibo_mtn: " << error.what() << '\n';
    return kFailed;
  }
  return 0;
}
