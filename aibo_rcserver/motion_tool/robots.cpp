#include "motion_tool/robots.h"

#include <utility>

namespace motion_tool {
namespace {

// Robot, and what Sony's motion files call it.
const std::pair<const char*, const char*> kRobots[] = {{"ERS-7", "DRX-1000"}, {"ERS-210", "DRX-910"}};

}  // namespace

std::string designOf(const std::string& robot) {
  for (const auto& [name, design] : kRobots) {
    if (robot == name) {
      return design;
    }
  }
  return robot;
}

std::string robotOf(const std::string& design) {
  for (const auto& [name, known_design] : kRobots) {
    if (design == known_design) {
      return name;
    }
  }
  return design;
}

const robot_model::RobotModel* modelOf(const std::string& design) {
  return robot_model::findRobotModel(robotOf(design).c_str());
}

}  // namespace motion_tool
