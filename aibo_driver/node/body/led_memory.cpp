#include "node/body/led_memory.h"

#include <cmath>
#include <cstddef>
#include <limits>

namespace aibo_driver::node {

using aibo_client::LedCommand;
using aibo_client::LedMode;

namespace {

constexpr float kUnknownIntensity = std::numeric_limits<float>::quiet_NaN();
constexpr float kHighestIntensity = 255;  // on the wire

}  // namespace

LedMemory::LedMemory(const robot_model::RobotModel& model) : model_(model) {
  for (int i = 0; i < model.number_of_leds; ++i) {
    states_.names.emplace_back(model.leds[i].name);
  }
  setAll(kUnknownIntensity);
}

bool LedMemory::update(const aibo_client::ConnectionStatus& status) {
  const bool is_connected = status.state == aibo_client::ConnectionState::kConnected;
  if (is_connected == is_connected_) {
    return false;
  }
  is_connected_ = is_connected;
  setAll(is_connected && status.protocol_version >= 2 ? 0 : kUnknownIntensity);
  return true;
}

bool LedMemory::accept(const std::vector<LedCommand>& leds) {
  bool is_changed = false;
  for (const LedCommand& command : leds) {
    const int led = robot_model::findLedByIdentifier(model_, command.id);
    if (led == robot_model::NO_LED) {
      continue;
    }
    const auto index = static_cast<std::size_t>(led);
    const bool is_on_or_off = model_.leds[led].kind == robot_model::LED2;
    const float intensity = static_cast<float>(command.intensity) / kHighestIntensity;
    const float shown = is_on_or_off ? std::ceil(intensity) : intensity;
    const auto mode = !is_on_or_off && command.mode == LedMode::kB ? LedStates::MODE_B : LedStates::MODE_A;
    is_changed = is_changed || states_.intensities[index] != shown || states_.modes[index] != mode;
    states_.intensities[index] = shown;
    states_.modes[index] = mode;
  }
  return is_changed;
}

void LedMemory::setAll(float intensity) {
  states_.intensities.assign(states_.names.size(), intensity);
  states_.modes.assign(states_.names.size(), LedStates::MODE_A);
}

}  // namespace aibo_driver::node
