/// @file motion_end.h
#ifndef AIBO_CLIENT_MOTION_END_H
#define AIBO_CLIENT_MOTION_END_H

#include <cstdint>
#include <string>

namespace aibo_client {

/// What has ended. The numbers are those of docs/protocol.md.
enum class EndedKind {
  kUnknown = 0,  ///< something that only a newer server knows
  kMotion = 1,   ///< a motion that was played
  kWalk = 2,     ///< walking
  kPosture = 3,  ///< a change of posture
  kJam = 4,      ///< a joint's fault: the joint follows its commands again
  kJoints = 5    ///< a command to joints: none of its joints is under way for it any more
};

/// How something that the robot did, or should have done, has ended. The first five are what a robot says, with the
/// numbers of docs/protocol.md; all are the constants of aibo_msgs/EndedMovement.
enum class EndedHow {
  kDone = 0,        ///< the joints are measured where they were sent, or the robot says that it has done it
  kReplaced = 1,    ///< something else moves its joints now
  kStopped = 2,     ///< somebody has stopped it
  kRefused = 3,     ///< it was not begun, or the robot could not go on with it
  kFell = 4,        ///< the robot fell or was lifted
  kUnknown = 5,     ///< nothing says how it ended, or the robot says it in a way that only a newer client knows
  kNotReached = 6,  ///< its time is over, and a joint is not where it was sent
  kLost = 7         ///< the connection broke
};

/// Reports that something has ended on the robot. It is reported once for each order that the robot has accepted,
/// unless the connection ends first. A server of version 1 reports no ends. There, orders with a number end with
/// EndedHow::kUnknown once the robot has accepted them, or with kRefused if it has accepted only some of the joints.
struct MotionEnd {
  EndedKind kind = EndedKind::kUnknown;
  EndedHow how = EndedHow::kUnknown;
  std::string name;         ///< the name of the motion's file, the posture or the joint; may be empty
  std::string reason;       ///< in words for the user, such as which joint a command took; may be empty
  std::uint64_t order = 0;  ///< OrderTerms::number; 0 if the order has none, or if it is none of this connection
};

}  // namespace aibo_client

#endif  // AIBO_CLIENT_MOTION_END_H
