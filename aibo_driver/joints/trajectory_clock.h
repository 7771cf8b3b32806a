/// @file trajectory_clock.h
#ifndef AIBO_DRIVER_JOINTS_TRAJECTORY_CLOCK_H
#define AIBO_DRIVER_JOINTS_TRAJECTORY_CLOCK_H

#include <chrono>

namespace aibo_driver::joints {

/// How far a trajectory has got. It does not go on while nobody attends to it for long: the joints have stopped
/// meanwhile, and would have to jump to catch up.
class TrajectoryClock {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  /// Who attends later than this goes on where the trajectory was.
  static constexpr std::chrono::milliseconds kLongestGap{200};

  /// @param start when it begins
  /// @param period in which attend() is called, well below kLongestGap
  TrajectoryClock(SteadyTime start, std::chrono::milliseconds period)
      : start_(start), attended_(start), period_(period) {}

  /// Seconds from its beginning, below 0 before.
  double at(SteadyTime now) const;

  /// The same, for who moves the joints on from now.
  double attend(SteadyTime now);

 private:
  SteadyTime::duration excess(SteadyTime now) const;

  SteadyTime start_;
  SteadyTime attended_;  ///< last, or when it begins
  std::chrono::milliseconds period_;
};

}  // namespace aibo_driver::joints

#endif  // AIBO_DRIVER_JOINTS_TRAJECTORY_CLOCK_H
