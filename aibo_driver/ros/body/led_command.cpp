#include "ros/body/led_command.h"

#include <cmath>
#include <cstddef>
#include <map>
#include <sstream>

namespace aibo_driver::node {
namespace {

struct Group {
  const char* name;
  robot_model::LedPlace place;
};

constexpr Group kGroups[] = {{"face", robot_model::LED_ON_FACE},
                             {"head", robot_model::LED_ON_HEAD},
                             {"back", robot_model::LED_ON_BACK},
                             {"tail", robot_model::LED_ON_TAIL}};

constexpr float kHighestIntensity = 255;  // on the wire

bool isNamed(const robot_model::Led& led, const std::string& name) {
  if (name == "all" || name == led.name) {
    return true;
  }
  for (const Group& group : kGroups) {
    if (name == group.name) {
      return led.place == group.place;
    }
  }
  return false;
}

std::vector<int> findLeds(const std::string& name, const robot_model::RobotModel& model) {
  std::vector<int> ids;
  for (int i = 0; i < model.number_of_leds; ++i) {
    if (isNamed(model.leds[i], name)) {
      ids.push_back(model.leds[i].identifier);
    }
  }
  return ids;
}

// What is wrong with the message as a whole; empty if nothing is.
std::string describeMisfit(const Leds& message) {
  if (message.intensities.size() != message.names.size() && message.intensities.size() != 1) {
    return "A message on leds was refused: it has " + std::to_string(message.names.size()) + " names and " +
           std::to_string(message.intensities.size()) + " intensities; allowed is one for each, or one for all.";
  }
  if (message.mode != Leds::MODE_A && message.mode != Leds::MODE_B) {
    return "A message on leds was refused: there is no mode " + std::to_string(message.mode) +
           "; allowed is 0 (MODE_A) or 1 (MODE_B).";
  }
  return {};
}

}  // namespace

LedOrders parseLeds(const Leds& message, const robot_model::RobotModel& model) {
  LedOrders orders;
  const std::string misfit = describeMisfit(message);
  if (!misfit.empty()) {
    orders.refusals.push_back(misfit);
    return orders;
  }
  std::map<int, LedCommand> commands;
  for (std::size_t i = 0; i < message.names.size(); ++i) {
    const std::string& name = message.names[i];
    const float intensity = message.intensities[message.intensities.size() == 1 ? 0 : i];
    const std::vector<int> ids = findLeds(name, model);
    if (ids.empty()) {
      orders.refusals.push_back("There is no LED and no group of LEDs named '" + name + "': it is left out.");
    } else if (!(intensity >= 0 && intensity <= 1)) {
      std::ostringstream text;
      text << "LED " << name << " cannot shine with intensity " << intensity << ", which is not 0..1: it is left out.";
      orders.refusals.push_back(text.str());
    } else {
      // Rounded up: what is not off is on, however dark.
      const int level = static_cast<int>(std::ceil(intensity * kHighestIntensity));
      for (const int id : ids) {
        commands[id] = {id, level, message.mode == Leds::MODE_B ? LedMode::kB : LedMode::kA};
      }
    }
  }
  for (const auto& command : commands) {
    orders.commands.push_back(command.second);
  }
  return orders;
}

}  // namespace aibo_driver::node
