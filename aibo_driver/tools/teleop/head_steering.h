/// @file head_steering.h
#ifndef AIBO_DRIVER_TOOLS_TELEOP_HEAD_STEERING_H
#define AIBO_DRIVER_TOOLS_TELEOP_HEAD_STEERING_H

#include <chrono>
#include <optional>

namespace teleop {

/// How fast the head turns, in rad/s.
struct HeadVelocity {
  double pan = 0;   ///< positive to the left
  double tilt = 0;  ///< positive up
};

/// Where the head looks, in rad.
struct HeadPosition {
  double pan = 0;   ///< positive to the left
  double tilt = 0;  ///< positive up
};

/// Turns velocities of the head into positions to command. The positions begin where the head is measured, end at the
/// limits of an ERS-7's joints, and never run far ahead of the head.
class HeadSteering {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// Call this with the measured position of the head.
  void measured(const HeadPosition& position);

  /// Call this several times a second.
  /// @param velocity empty: the head is not steered, and others may move it
  /// @return the position to command; empty if the head is not steered, or has not been measured yet
  std::optional<HeadPosition> steer(const std::optional<HeadVelocity>& velocity, TimePoint now);

 private:
  std::optional<HeadPosition> measured_;
  std::optional<HeadPosition> target_;  ///< empty while the head is not steered
  TimePoint last_;
};

}  // namespace teleop

#endif  // AIBO_DRIVER_TOOLS_TELEOP_HEAD_STEERING_H
