/// @file motors_and_posture.h
#ifndef AIBO_DRIVER_MOTORS_AND_POSTURE_H
#define AIBO_DRIVER_MOTORS_AND_POSTURE_H

namespace aibo_driver {

enum class MotorState {
  kUnknown,  ///< no connection, or the server does not tell
  kOff,      ///< the joints can be moved by hand
  kOn
};

/// How the robot is at the moment. Posture is what it can be told to take (walk.h).
enum class PostureNow {
  kUnknown,  ///< none of the others, no connection, or the server does not tell
  kStanding,
  kSitting,
  kLying,
  kWalking,
  kFallen,  ///< on its side or its back
  kCarried  ///< lifted
};

/// What the robot can do now. A server that speaks version 1, or that is older than this, does not tell.
struct MotorsAndPosture {
  MotorState motors = MotorState::kUnknown;
  PostureNow posture = PostureNow::kUnknown;
};

inline bool operator==(const MotorsAndPosture& a, const MotorsAndPosture& b) {
  return a.motors == b.motors && a.posture == b.posture;
}

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_MOTORS_AND_POSTURE_H
