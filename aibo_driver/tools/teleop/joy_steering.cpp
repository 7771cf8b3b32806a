#include "tools/teleop/joy_steering.h"

#include <algorithm>
#include <cmath>

namespace teleop {

std::optional<aibo_driver::WalkVelocity> JoySteering::steer(const std::vector<float>& axes,
                                                            const std::vector<int>& buttons) {
  const bool is_pressed =
      problem(axes.size(), buttons.size()).empty() && buttons[static_cast<std::size_t>(mapping_.dead_man_button)] != 0;
  if (!is_pressed && !steers_) {
    return std::nullopt;
  }
  steers_ = is_pressed;
  if (!is_pressed) {
    return aibo_driver::WalkVelocity();
  }
  const auto at = [&](int axis) { return deflection(axes[static_cast<std::size_t>(axis)]); };
  return aibo_driver::WalkVelocity{at(mapping_.forward_axis) * mapping_.speeds.forward,
                                   at(mapping_.left_axis) * mapping_.speeds.left,
                                   at(mapping_.turn_axis) * mapping_.speeds.turn};
}

std::string JoySteering::problem(std::size_t axes, std::size_t buttons) const {
  const int last_axis = std::max({mapping_.forward_axis, mapping_.left_axis, mapping_.turn_axis});
  if (static_cast<std::size_t>(last_axis) < axes && static_cast<std::size_t>(mapping_.dead_man_button) < buttons) {
    return "";
  }
  return "The joystick has " + std::to_string(axes) + " axes and " + std::to_string(buttons) +
         " buttons, but its mapping names axis " + std::to_string(last_axis) + " and button " +
         std::to_string(mapping_.dead_man_button) +
         ", counted from 0. It does not steer. See config/joy.yaml, and rostopic echo /joy.";
}

// From the edge of the dead zone on, it begins at 0.
double JoySteering::deflection(double axis) const {
  const double size = std::min(std::abs(axis), 1.0);
  if (!(size > mapping_.dead_zone)) {  // or not a number
    return 0;
  }
  return std::copysign((size - mapping_.dead_zone) / (1 - mapping_.dead_zone), axis);
}

}  // namespace teleop
