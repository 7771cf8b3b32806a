#include "tools/teleop/joy_steering.h"

#include <algorithm>
#include <cmath>

#include "robot_model/robot_model.h"

namespace teleop {
namespace {

// The longest time for which a message turns the head. If messages come less often, the head turns more slowly.
constexpr double kLongestStep = 0.1;  // s

// How far a command may be ahead of the head, because the head may be slow, or somebody may hold it.
constexpr double kFurthestAhead = 0.3;  // rad

double advance(const char* joint, double target, double measured, double way) {
  const robot_model::RobotModel& model = *robot_model::findRobotModel("ERS-7");
  const robot_model::Joint& limits = model.joints[robot_model::findJointByName(model, joint)];
  const double ahead = std::clamp(target + way, measured - kFurthestAhead, measured + kFurthestAhead);
  return std::clamp(ahead, limits.lowest * 1e-6, limits.highest * 1e-6);
}

bool isPressed(const std::vector<int>& buttons, int button) {
  return button != kNoPlace && static_cast<std::size_t>(button) < buttons.size() &&
         buttons[static_cast<std::size_t>(button)] != 0;
}

/// The button of each use.
std::map<std::string, int> buttonsOf(const JoyMapping& mapping) {
  std::map<std::string, int> buttons = {{"dead_man_button", mapping.dead_man_button},
                                        {"stop_button", mapping.stop_button},
                                        {"release_button", mapping.release_button},
                                        {"picture_button", mapping.picture_button}};
  for (const auto& [motion, button] : mapping.motions) {
    buttons["motions/" + motion] = button;
  }
  for (const auto& [posture, button] : mapping.postures) {
    buttons["postures/" + posture] = button;
  }
  return buttons;
}

int lastButtonOf(const JoyMapping& mapping) {
  int last = kNoPlace;
  for (const auto& [use, button] : buttonsOf(mapping)) {
    last = std::max(last, button);
  }
  return last;
}

}  // namespace

std::string problemOf(const JoyMapping& mapping) {
  std::map<int, std::string> uses;
  for (const auto& [use, button] : buttonsOf(mapping)) {
    if (const auto [other, is_free] = uses.emplace(button, use); button != kNoPlace && !is_free) {
      return "Button " + std::to_string(button) + " is " + other->second + " and " + use +
             "; each needs its own, or -1 for none.";
    }
  }
  return "";
}

JoySteering::JoySteering(const JoyMapping& mapping)
    : mapping_(mapping),
      last_axis_(
          std::max({mapping.forward_axis, mapping.left_axis, mapping.turn_axis, mapping.pan_axis, mapping.tilt_axis})),
      last_button_(lastButtonOf(mapping)) {}

JoyOrders JoySteering::read(const std::vector<float>& axes, const std::vector<int>& buttons) {
  JoyOrders orders;
  const bool fits = problem(axes.size(), buttons.size()).empty();
  const bool holds_dead_man = fits && isPressed(buttons, mapping_.dead_man_button);
  orders.stop = isNew(buttons, mapping_.stop_button);
  orders.release = isNew(buttons, mapping_.release_button) && holds_dead_man && !orders.stop;
  orders.take_picture = fits && isNew(buttons, mapping_.picture_button);
  is_halted_ = (is_halted_ || orders.stop || orders.release) && holds_dead_man;
  const bool is_pressed = holds_dead_man && !is_halted_;
  readSticks(is_pressed, axes, &orders);
  readButtons(is_pressed, buttons, &orders);
  buttons_ = buttons;
  return orders;
}

// Reads the sticks. When the button is released, the robot gets one order to stop.
void JoySteering::readSticks(bool is_pressed, const std::vector<float>& axes, JoyOrders* orders) {
  if (is_pressed) {
    orders->walk = {deflection(axes, mapping_.forward_axis) * mapping_.speeds.forward,
                    deflection(axes, mapping_.left_axis) * mapping_.speeds.left,
                    deflection(axes, mapping_.turn_axis) * mapping_.speeds.turn};
    const PanTilt head = {deflection(axes, mapping_.pan_axis) * mapping_.head_speed,
                          deflection(axes, mapping_.tilt_axis) * mapping_.head_speed};
    if (head.pan != 0 || head.tilt != 0) {
      orders->head = head;
    }
  } else if (steers_) {
    orders->walk = aibo_client::WalkVelocity();
  }
  steers_ = is_pressed;
}

void JoySteering::readButtons(bool is_pressed, const std::vector<int>& buttons, JoyOrders* orders) {
  if (!is_pressed) {
    return;
  }
  for (const auto& [name, button] : mapping_.motions) {
    orders->motion = isNew(buttons, button) ? name : orders->motion;
  }
  for (const auto& [name, button] : mapping_.postures) {
    orders->posture = isNew(buttons, button) ? name : orders->posture;
  }
}

bool JoySteering::isNew(const std::vector<int>& buttons, int button) const {
  return isPressed(buttons, button) && !isPressed(buttons_, button);
}

std::string JoySteering::problem(std::size_t axes, std::size_t buttons) const {
  if (last_axis_ < static_cast<int>(axes) && last_button_ < static_cast<int>(buttons)) {
    return "";
  }
  return "The joystick has " + std::to_string(axes) + " axes and " + std::to_string(buttons) +
         " buttons, but its mapping names axis " + std::to_string(last_axis_) + " and button " +
         std::to_string(last_button_) +
         ", counted from 0. It does not steer. Change the mapping (config/joy.yaml; -1 is none), and see rostopic echo "
         "/joy.";
}

// The deflection of an axis. It begins at 0 at the edge of the dead zone.
double JoySteering::deflection(const std::vector<float>& axes, int axis) const {
  if (axis == kNoPlace) {
    return 0;
  }
  const double value = axes[static_cast<std::size_t>(axis)];
  const double size = std::min(std::abs(value), 1.0);
  if (!(size > mapping_.dead_zone)) {  // the negation also catches a number that is NaN
    return 0;
  }
  return std::copysign((size - mapping_.dead_zone) / (1 - mapping_.dead_zone), value);
}

void HeadSteering::measured(const PanTilt& position) {
  measured_ = position;
}

std::optional<PanTilt> HeadSteering::steer(const std::optional<PanTilt>& velocity, TimePoint now) {
  if (!velocity || !measured_) {
    target_.reset();
    return std::nullopt;
  }
  if (!target_) {
    target_ = measured_;
    last_ = now;
  }
  const double step = std::min(std::chrono::duration<double>(now - last_).count(), kLongestStep);
  last_ = now;
  target_->pan = advance("head_pan", target_->pan, measured_->pan, velocity->pan * step);
  target_->tilt = advance("head_tilt", target_->tilt, measured_->tilt, velocity->tilt * step);
  return target_;
}

}  // namespace teleop
