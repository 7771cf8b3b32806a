/// @file walk.h
/// How a robot walks, its postures and its motors. Velocities are relative to the floor, in the robot's own directions,
/// with the signs of REP 103.
#ifndef AIBO_CLIENT_WALK_H
#define AIBO_CLIENT_WALK_H

namespace aibo_client {

struct WalkVelocity {
  double forward = 0;  ///< m/s, negative means backward
  double left = 0;     ///< m/s, negative means to the right
  double turn = 0;     ///< rad/s, positive means to the left, that is, counterclockwise seen from above

  bool isZero() const { return forward == 0 && left == 0 && turn == 0; }
};

/// The robot's highest walking speeds, as its server reports them. All are 0 if it cannot walk.
struct WalkLimits {
  double forward = 0;  ///< m/s
  double back = 0;     ///< m/s, positive
  double left = 0;     ///< m/s, to either side
  double turn = 0;     ///< rad/s, in either direction
};

/// A posture to take, with the number of docs/protocol.md.
enum class Posture {
  kStand = 1,
  kSit = 2,
  kRest = 3  ///< the robot lies down, then switches its motors off
};

/// The first three numbers are those of docs/protocol.md.
enum class WalkState {
  kNone = 0,       ///< it does not walk
  kGetsReady = 1,  ///< it stands up before it walks
  kWalks = 2,
  kUnknown = 3  ///< something that only a newer server knows
};

/// How the robot walked when telemetry was measured.
struct WalkReading {
  /// The average velocity of the body since the previous telemetry, computed from the measured joints and pressed paws.
  /// If no foot slips, its integral over time is the distance walked.
  WalkVelocity velocity;
  double phase = 0;  ///< the phase of the step, 0..1
  WalkState state = WalkState::kNone;
};

enum class MotorState {
  kUnknown,  ///< not known: there is no connection, or the server does not report motors
  kOff,      ///< the joints can be moved by hand
  kOn
};

/// The robot's present posture, with the numbers of docs/protocol.md. Posture lists the postures that it can be told to
/// take.
enum class PostureNow {
  kUnknown = 0,  ///< none of the others, no connection, or the server does not report it
  kStanding = 1,
  kSitting = 2,
  kLying = 3,
  kWalking = 4,
  kFallen = 5,  ///< the robot lies on its side or its back
  kCarried = 6  ///< the robot is lifted
};

/// What the robot can do now. A server of version 1 does not report this.
struct MotorsAndPosture {
  MotorState motors = MotorState::kUnknown;
  PostureNow posture = PostureNow::kUnknown;
};

inline bool operator==(const MotorsAndPosture& a, const MotorsAndPosture& b) {
  return a.motors == b.motors && a.posture == b.posture;
}

}  // namespace aibo_client

#endif  // AIBO_CLIENT_WALK_H
