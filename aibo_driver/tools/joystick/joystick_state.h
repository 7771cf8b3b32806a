/// @file joystick_state.h
/// How a joystick or gamepad is held, and what is to be reported of it. Without SDL and ROS.
#ifndef AIBO_DRIVER_TOOLS_JOYSTICK_JOYSTICK_STATE_H
#define AIBO_DRIVER_TOOLS_JOYSTICK_JOYSTICK_STATE_H

#include <chrono>
#include <optional>
#include <vector>

namespace joystick {

/// As in sensor_msgs/Joy.
struct State {
  std::vector<float> axes;   ///< -1..1; positive is to the left and up
  std::vector<int> buttons;  ///< 0 or 1
};

bool operator==(const State& left, const State& right);

/// Decides what is published of a joystick, and when: each change, and the same again several times a second, so that
/// a listener notices when the joystick or this program is gone.
class Reporter {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// @param dead_zone 0..0.9; a smaller deflection of an axis is reported as 0, and beyond it an axis begins at 0
  /// @param repeat_period after which the same is reported again; 0 = never
  Reporter(double dead_zone, std::chrono::nanoseconds repeat_period)
      : dead_zone_(dead_zone), repeat_period_(repeat_period) {}

  /// To be called often.
  /// @param state none: there is no joystick
  /// @return what to publish now, if anything. When the joystick is gone, once, that nothing is pressed or deflected.
  std::optional<State> report(const std::optional<State>& state, TimePoint now);

 private:
  State withDeadZone(const State& state) const;

  const double dead_zone_;
  const std::chrono::nanoseconds repeat_period_;
  std::optional<State> last_;  ///< reported, while there is a joystick
  TimePoint reported_;
};

}  // namespace joystick

#endif  // AIBO_DRIVER_TOOLS_JOYSTICK_JOYSTICK_STATE_H
