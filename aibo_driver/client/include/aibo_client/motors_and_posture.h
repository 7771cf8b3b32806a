/// @file motors_and_posture.h
#ifndef AIBO_CLIENT_MOTORS_AND_POSTURE_H
#define AIBO_CLIENT_MOTORS_AND_POSTURE_H

namespace aibo_client {

enum class MotorState {
  kUnknown,  ///< not known: there is no connection, or the server does not report motors
  kOff,      ///< the joints can be moved by hand
  kOn
};

/// The robot's present posture. Posture lists the postures that it can be told to take (walk.h).
enum class PostureNow {
  kUnknown,  ///< none of the others, no connection, or the server does not report it
  kStanding,
  kSitting,
  kLying,
  kWalking,
  kFallen,  ///< the robot lies on its side or its back
  kCarried  ///< the robot is lifted
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

#endif  // AIBO_CLIENT_MOTORS_AND_POSTURE_H
