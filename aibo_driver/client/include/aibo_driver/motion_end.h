/// @file motion_end.h
#ifndef AIBO_DRIVER_MOTION_END_H
#define AIBO_DRIVER_MOTION_END_H

#include <string>

namespace aibo_driver {

/// What a version 2 server reports as ended.
enum class EndedKind {
  kUnknown,  ///< something that only a newer server knows
  kMotion,   ///< a motion that was played
  kWalk,     ///< walking
  kPosture,  ///< a change of posture
  kJam       ///< a joint's fault: the joint follows its commands again
};

/// How it has ended.
enum class EndedHow {
  kUnknown,   ///< in a way that only a newer server knows
  kDone,      ///< it has reached its end
  kReplaced,  ///< a command or another motion took its joints
  kStopped,   ///< the client or the motors' switch stopped it
  kRefused,   ///< the robot could not go on with it
  kFell       ///< the robot fell or was lifted
};

/// The robot's report that something it did has ended.
struct MotionEnd {
  EndedKind kind = EndedKind::kUnknown;
  EndedHow how = EndedHow::kUnknown;
  std::string name;    ///< of the motion's file, posture or joint; may be empty
  std::string reason;  ///< in words for the user, such as which joint a command took; may be empty
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_MOTION_END_H
