#include "node/body/led_state_publisher.h"

#include <cmath>
#include <limits>

#include "node/publish_latched.h"

namespace aibo_driver::node {

using aibo_client::LedCommand;
using aibo_client::LedMode;

namespace {

constexpr float kUnknownIntensity = std::numeric_limits<float>::quiet_NaN();
constexpr float kHighestIntensity = 255;  // on the wire

bool areEqual(float left, float right) {
  return left == right || (std::isnan(left) && std::isnan(right));
}

}  // namespace

LedMemory::LedMemory(const robot_model::RobotModel& model) : model_(model) {
  for (int i = 0; i < model.number_of_leds; ++i) {
    states_.names.emplace_back(model.leds[i].name);
  }
  states_.intensities.assign(states_.names.size(), kUnknownIntensity);
  states_.modes.assign(states_.names.size(), LedStates::MODE_A);
}

bool LedMemory::update(const aibo_client::ConnectionStatus& status) {
  const bool is_connected = status.state == aibo_client::ConnectionState::kConnected;
  if (is_connected == is_connected_) {
    return false;
  }
  is_connected_ = is_connected;
  return setAll(is_connected && status.protocol_version >= 2 ? 0 : kUnknownIntensity);
}

bool LedMemory::accept(const std::vector<LedCommand>& leds) {
  bool has_changed = false;
  for (const LedCommand& command : leds) {
    const int led = robot_model::findLedByIdentifier(model_, command.id);
    if (led == robot_model::NO_LED) {
      continue;
    }
    const bool is_on_or_off = model_.leds[led].kind == robot_model::LED2;
    const float intensity = static_cast<float>(command.intensity) / kHighestIntensity;
    has_changed |= set(static_cast<std::size_t>(led), is_on_or_off ? std::ceil(intensity) : intensity,
                       is_on_or_off ? LedMode::kA : command.mode);
  }
  return has_changed;
}

bool LedMemory::setAll(float intensity) {
  bool has_changed = false;
  for (std::size_t i = 0; i < states_.names.size(); ++i) {
    has_changed |= set(i, intensity, LedMode::kA);
  }
  return has_changed;
}

bool LedMemory::set(std::size_t led, float intensity, LedMode mode) {
  const std::uint8_t mode_number = mode == LedMode::kB ? LedStates::MODE_B : LedStates::MODE_A;
  if (areEqual(states_.intensities[led], intensity) && states_.modes[led] == mode_number) {
    return false;
  }
  states_.intensities[led] = intensity;
  states_.modes[led] = mode_number;
  return true;
}

LedStatePublisher::LedStatePublisher(const ros::NodeHandle& handle, const robot_model::RobotModel& model)
    : memory_(model) {
  constexpr bool kLatched = true;
  publisher_ = ros::NodeHandle(handle).advertise<LedStates>("led_states", 1, kLatched);
  publish();
}

void LedStatePublisher::update(const aibo_client::ConnectionStatus& status) {
  if (memory_.update(status)) {
    publish();
  }
}

void LedStatePublisher::accept(const std::vector<LedCommand>& leds) {
  if (memory_.accept(leds)) {
    publish();
  }
}

void LedStatePublisher::publish() {
  LedStates message = memory_.states();
  message.header.stamp = ros::Time::now();
  publishLatched(publisher_, message);
}

}  // namespace aibo_driver::node
