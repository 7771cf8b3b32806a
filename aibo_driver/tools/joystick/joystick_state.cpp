#include "tools/joystick/joystick_state.h"

#include <algorithm>
#include <cmath>

namespace joystick {

bool operator==(const State& left, const State& right) {
  return left.axes == right.axes && left.buttons == right.buttons;
}

std::optional<State> Reporter::report(const std::optional<State>& state, TimePoint now) {
  if (!state && !last_) {
    return std::nullopt;
  }
  if (!state) {
    State released = *last_;
    std::fill(released.axes.begin(), released.axes.end(), 0.0F);
    std::fill(released.buttons.begin(), released.buttons.end(), 0);
    last_.reset();
    return released;
  }
  const State held = withDeadZone(*state);
  const bool is_due = repeat_period_.count() > 0 && now - reported_ >= repeat_period_;
  if (last_ && held == *last_ && !is_due) {
    return std::nullopt;
  }
  last_ = held;
  reported_ = now;
  return held;
}

State Reporter::withDeadZone(const State& state) const {
  State result = state;
  for (float& axis : result.axes) {
    const double size = std::min(std::abs(static_cast<double>(axis)), 1.0);
    const double beyond = std::max(size - dead_zone_, 0.0) / (1 - dead_zone_);
    axis = static_cast<float>(std::copysign(beyond, axis)) + 0.0F;  // adding 0 avoids a negative zero
  }
  return result;
}

}  // namespace joystick
