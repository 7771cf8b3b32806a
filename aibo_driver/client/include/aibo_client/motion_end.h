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

/// Reports that something has ended on the robot. It is reported once for each order that the robot has begun, unless
/// the connection ends first; Callbacks::on_steered says which velocities are reported. A server of version 1 reports
/// no ends. There, the client ends an order with a number: with EndedHow::kRefused if the robot has refused a part of
/// it, otherwise with EndedHow::kUnknown once the robot has accepted what was sent of it.
struct ActivityEnd {
  EndedKind kind = EndedKind::kUnknown;
  EndedHow how = EndedHow::kUnknown;
  std::string name;    ///< the name of the motion's file, the posture or the joint; may be empty
  std::string reason;  ///< in words for the user, such as which joint a command took; may be empty
  /// The order's OrderTerms::number; 0 if it has no number or was not given over this connection.
  std::uint64_t order = 0;
};

}  // namespace aibo_client

#endif  // AIBO_CLIENT_MOTION_END_H
