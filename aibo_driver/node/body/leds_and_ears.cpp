#include "node/body/leds_and_ears.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <sstream>

#include "aibo_client/exceptions.h"
#include "movement/joint_table.h"
#include "movement/movement.h"
#include "node/orders.h"

namespace aibo_driver::node {
namespace {

// Several programs may each command some of the LEDs, so messages must not replace each other.
constexpr std::uint32_t kLedsAndEarsQueueSize = 10;

constexpr std::size_t kMostBytes = 256 << 10;  // far more than a message to all LEDs of a robot

constexpr double kHighestLevel = 255;  // on the wire

bool isNamed(const robot_model::Led& led, const std::string& name) {
  static const std::map<std::string, robot_model::LedPlace> groups = {{"face", robot_model::LED_ON_FACE},
                                                                      {"head", robot_model::LED_ON_HEAD},
                                                                      {"back", robot_model::LED_ON_BACK},
                                                                      {"tail", robot_model::LED_ON_TAIL}};
  const auto group = groups.find(name);
  return name == "all" || name == led.name || (group != groups.end() && group->second == led.place);
}

// @return RCServer identifiers; empty if the robot has no LED and no group of this name
std::vector<int> findLeds(const std::string& name, const robot_model::RobotModel& model) {
  std::vector<int> ids;
  for (int i = 0; i < model.number_of_leds; ++i) {
    if (isNamed(model.leds[i], name)) {
      ids.push_back(model.leds[i].identifier);
    }
  }
  return ids;
}

// Rounds up, so that the lowest intensity above 0 is not off.
int ledLevel(double intensity) {
  constexpr double kRounding = 1e-4;  // 0.2 in a message is a float, and a little more than 0.2
  return static_cast<int>(std::ceil(intensity * kHighestLevel - kRounding));
}

// @return what is wrong with the message as a whole; empty if it is fine
std::string describeMisfit(const Leds& message) {
  const std::string too_many = movement::describeTooMany(message.names.size());
  if (!too_many.empty()) {
    return "A message on leds was refused: " + too_many + ".";
  }
  if (message.intensities.size() != message.names.size() && message.intensities.size() != 1) {
    return "A message on leds was refused: it has " + std::to_string(message.names.size()) + " names and " +
           std::to_string(message.intensities.size()) + " intensities; give one for each name, or one for all.";
  }
  if (message.mode != Leds::MODE_A && message.mode != Leds::MODE_B) {
    return "A message on leds was refused: there is no mode " + std::to_string(message.mode) +
           "; use 0 (MODE_A) or 1 (MODE_B).";
  }
  return {};
}

}  // namespace

ParsedLeds parseLeds(const Leds& message, const robot_model::RobotModel& model) {
  ParsedLeds orders;
  const std::string misfit = describeMisfit(message);
  if (!misfit.empty()) {
    orders.refusals.add(misfit);
    return orders;
  }
  std::map<int, aibo_client::LedCommand> commands;
  for (std::size_t i = 0; i < message.names.size(); ++i) {
    const std::string& name = message.names[i];
    const float intensity = message.intensities[message.intensities.size() == 1 ? 0 : i];
    const std::vector<int> ids = findLeds(name, model);
    if (ids.empty()) {
      orders.refusals.add("No LED or group of LEDs is named '" + text::plainLine(name) + "'.");
    } else if (!(intensity >= 0 && intensity <= 1)) {
      std::ostringstream text;
      text << "LED " << name << " cannot shine with intensity " << intensity << "; the range is 0..1.";
      orders.refusals.add(text.str());
    } else {
      const int level = ledLevel(intensity);
      for (const int id : ids) {
        commands[id] = {id, level, message.mode == Leds::MODE_B ? aibo_client::LedMode::kB : aibo_client::LedMode::kA};
      }
    }
  }
  for (const auto& command : commands) {
    orders.commands.push_back(command.second);
  }
  return orders;
}

void LedsAndEars::subscribe(const ros::NodeHandle& handle) {
  leds_ = subscribeToOrders<Leds, kMostBytes>(
      handle, "leds", kLedsAndEarsQueueSize, [this](const Leds& message, const auto&) { receiveLeds(message); },
      [this](const auto&, const std::string& reason) {
        warnings_.warn("A message on leds was refused: " + reason + ".");
      });
  ears_ = subscribeToOrders<Ears>(handle, "ears", kLedsAndEarsQueueSize,
                                  [this](const auto& message, const auto& order) { receiveEars(message, order); });
}

void LedsAndEars::receiveLeds(const Leds& message) {
  const ParsedLeds orders = parseLeds(message, model_);
  if (!orders.refusals.empty()) {
    warnings_.warn(orders.refusals.text(" "));
  }
  if (!orders.commands.empty()) {
    send("LEDs", [this, &orders] { client_.commandLeds(orders.commands); });
  }
}

void LedsAndEars::receiveEars(const Ears& message, const movement::Order& order) {
  send("ears", [&] {
    mover_.requirePermission(order);
    client_.commandEars(message.left != 0, message.right != 0);
  });
}

void LedsAndEars::send(const std::string& what, const std::function<void()>& command) {
  try {
    movement::requireDesign(client_, model_.design);
    command();
  } catch (const aibo_client::StoppedException&) {
    // Nothing is logged, because the client was stopped: the driver is ending.
  } catch (const aibo_client::Exception& error) {
    warnings_.warn("A command to the " + what + " was dropped: " + error.what());
  }
}

}  // namespace aibo_driver::node
