/// @file joystick_state.h
/// How a joystick or gamepad is held, and what to report about it. This needs neither SDL nor ROS.
#ifndef AIBO_DRIVER_TOOLS_JOYSTICK_JOYSTICK_STATE_H
#define AIBO_DRIVER_TOOLS_JOYSTICK_JOYSTICK_STATE_H

#include <chrono>
#include <optional>
#include <vector>

namespace joystick {

/// The state of a joystick, as in sensor_msgs/Joy.
struct State {
  std::vector<float> axes;   ///< -1..1; positive means to the left and up
  std::vector<int> buttons;  ///< 0 or 1
};

bool operator==(const State& left, const State& right);

/// Decides what is published about a joystick, and when. It reports each change. It also repeats the state several
/// times a second, so that a listener notices when the joystick or this program is gone.
class Reporter {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// @param dead_zone 0..0.9; a smaller deflection of an axis is reported as 0, and the values begin at 0 at its edge
  /// @param repeat_period the same state is reported again after this time; 0 means never
  Reporter(double dead_zone, std::chrono::nanoseconds repeat_period)
      : dead_zone_(dead_zone), repeat_period_(repeat_period) {}

  /// Call this often.
  /// @param state empty if there is no joystick
  /// @return what to publish now, if anything. When the joystick is gone, it reports once that nothing is pressed or
  ///   deflected
  std::optional<State> report(const std::optional<State>& state, TimePoint now);

 private:
  State withDeadZone(const State& state) const;

  const double dead_zone_;
  const std::chrono::nanoseconds repeat_period_;
  std::optional<State> last_;  ///< the last state reported; empty while there is no joystick
  TimePoint reported_;
};

}  // namespace joystick

#endif  // AIBO_DRIVER_TOOLS_JOYSTICK_JOYSTICK_STATE_H
