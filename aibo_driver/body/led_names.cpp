#include "body/led_names.h"

#include <cmath>

namespace aibo_driver::body {
namespace {

constexpr double kHighestLevel = 255;  // on the wire

struct Group {
  const char* name;
  robot_model::LedPlace place;
};

constexpr Group kGroups[] = {{"face", robot_model::LED_ON_FACE},
                             {"head", robot_model::LED_ON_HEAD},
                             {"back", robot_model::LED_ON_BACK},
                             {"tail", robot_model::LED_ON_TAIL}};

constexpr const char* kAll = "all";

bool isNamed(const robot_model::Led& led, const std::string& name) {
  if (name == kAll || name == led.name) {
    return true;
  }
  for (const Group& group : kGroups) {
    if (name == group.name) {
      return led.place == group.place;
    }
  }
  return false;
}

}  // namespace

std::vector<int> findLeds(const std::string& name, const robot_model::RobotModel& model) {
  std::vector<int> ids;
  for (int i = 0; i < model.number_of_leds; ++i) {
    if (isNamed(model.leds[i], name)) {
      ids.push_back(model.leds[i].identifier);
    }
  }
  return ids;
}

std::vector<std::string> namesOfLeds(const robot_model::RobotModel& model) {
  std::vector<std::string> names = {kAll};
  for (const Group& group : kGroups) {
    if (!findLeds(group.name, model).empty()) {
      names.emplace_back(group.name);
    }
  }
  for (int i = 0; i < model.number_of_leds; ++i) {
    names.emplace_back(model.leds[i].name);
  }
  return names;
}

int ledLevel(double intensity) {
  constexpr double kRounding = 1e-4;  // 0.2 in a message is a float, and a little more than 0.2
  return static_cast<int>(std::ceil(intensity * kHighestLevel - kRounding));
}

}  // namespace aibo_driver::body
