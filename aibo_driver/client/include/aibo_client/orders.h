/// @file orders.h
/// The terms of an order to the robot, and the client's reports of how orders end.
#ifndef AIBO_CLIENT_ORDERS_H
#define AIBO_CLIENT_ORDERS_H

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace aibo_client {

/// How long an order may be on its way to the robot, unless its caller says otherwise. Later than that, a movement
/// would surprise a user who has seen that nothing moves. The value is our choice.
constexpr std::chrono::milliseconds kLongestOrderWait{500};

/// The terms of an order to move.
struct OrderTerms {
  /// After this time the order is too old: it is not sent any more, and a robot of version 2 that gets it later refuses
  /// it. The robot decides by its own clock, in frames of 8 ms. If an order has waited before it reaches the client,
  /// its caller should count from the time when it was received. Nothing that stops the robot is ever too old.
  std::chrono::steady_clock::time_point not_after = std::chrono::steady_clock::now() + kLongestOrderWait;
  /// A number of the caller's choice, by which Refusal and ActivityEnd name the order. 0 means no number.
  std::uint64_t number = 0;
};

/// Requests whose refusal is reported.
enum class RefusedRequest {
  kJoints,
  kSpeedLimits,
  kWalk,
  kLeds,
  kEars,
  kMicrophone,
  kMotion,  ///< not reported if it has no OrderTerms::number and a call waits for it, because that call throws
  kPosture  ///< not reported in the same case as kMotion
};

/// Why such a request is not carried out. New causes may be added at the end.
enum class RefusalCause {
  kRobot,    ///< the robot has refused the request
  kTooOld,   ///< the request could not reach the robot by OrderTerms::not_after or within the call's time
  kStopped,  ///< a stop, a posture, a motion or the motors' switch came before the request was sent
  kReplaced  ///< before the request was sent, a later one took its joints (`ids`) or gave another velocity
};

/// Reports that a request was refused, or was dropped before it was sent. An order that was refused never begins.
struct Refusal {
  RefusedRequest request = RefusedRequest::kJoints;
  RefusalCause cause = RefusalCause::kRobot;
  std::vector<int> ids;     ///< the ids of the joints, LEDs or ears concerned; otherwise empty
  std::string reason;       ///< the reason in words for the user, without a full stop
  std::uint64_t order = 0;  ///< OrderTerms::number; 0 if it has none, or if the rest of the order goes on without `ids`
};

/// What has ended. The numbers are those of docs/protocol.md.
enum class EndedKind {
  kUnknown = 0,  ///< something that only a newer server knows
  kMotion = 1,   ///< a motion that was played
  kWalk = 2,     ///< walking
  kPosture = 3,  ///< a change of posture
  kJam = 4,      ///< a joint's fault: the joint follows its commands again
  kJoints = 5    ///< a command to joints: no joint moves for it any more
};

/// How something that the robot did, or should have done, has ended. All are constants of aibo_msgs/EndedMovement. The
/// first five are reported by robots, with the numbers of docs/protocol.md.
enum class EndedHow {
  kDone = 0,        ///< the joints are measured where they were sent, or the robot says that it has done it
  kReplaced = 1,    ///< something else now moves the joints
  kStopped = 2,     ///< somebody has stopped it
  kRefused = 3,     ///< the robot did not begin it, or could not go on with it
  kFell = 4,        ///< the robot fell or was lifted
  kUnknown = 5,     ///< nothing says how it ended, or the robot says it in a way that only a newer client knows
  kNotReached = 6,  ///< its time is over, but not all joints are where they were sent
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

#endif  // AIBO_CLIENT_ORDERS_H
