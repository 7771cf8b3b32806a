/// @file walk.h
/// How a robot walks, and the postures that it takes. Velocities are over the floor, in the robot's own directions,
/// with the signs of REP 103.
#ifndef AIBO_DRIVER_WALK_H
#define AIBO_DRIVER_WALK_H

namespace aibo_driver {

struct WalkVelocity {
  double forward = 0;  ///< m/s, negative = backward
  double left = 0;     ///< m/s, negative = to the right
  double turn = 0;     ///< rad/s, positive = to the left, that is, counterclockwise seen from above

  bool isZero() const { return forward == 0 && left == 0 && turn == 0; }
};

/// The fastest that a robot walks, as its server reports it. All are 0 if it does not walk.
struct WalkLimits {
  double forward = 0;  ///< m/s
  double back = 0;     ///< m/s, positive
  double left = 0;     ///< m/s, to either side
  double turn = 0;     ///< rad/s, in either direction
};

enum class Posture {
  kStand,
  kSit,
  kRest  ///< lies down, then switches its motors off
};

enum class WalkState {
  kNone,       ///< does not walk
  kGetsReady,  ///< stands up
  kWalks,
  kUnknown  ///< something that only a newer server knows
};

/// How the robot walked when telemetry was measured.
struct WalkReading {
  /// Of the feet, as they were commanded since the telemetry before, on average, after all limits. Its sum over time is
  /// the way, if no foot has slipped.
  WalkVelocity velocity;
  double phase = 0;  ///< of the step, 0..1
  WalkState state = WalkState::kNone;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_WALK_H
