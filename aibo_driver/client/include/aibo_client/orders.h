/// @file orders.h
/// The terms of an order to the robot, and the client's reports about orders that were not carried out.
#ifndef AIBO_CLIENT_ORDERS_H
#define AIBO_CLIENT_ORDERS_H

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace aibo_client {

/// How long an order may wait before it is sent, unless its caller says otherwise. An order to move is meant for now:
/// after this time the user has seen that nothing moves. The value is our choice.
constexpr std::chrono::milliseconds kLongestOrderWait{500};

/// The terms of an order to move.
struct OrderTerms {
  /// After this time the order is too old and is not sent any more. If an order has waited before it reaches the
  /// client, its caller should count from the time when it was received.
  std::chrono::steady_clock::time_point not_after = std::chrono::steady_clock::now() + kLongestOrderWait;
  /// A number of the caller's choice. Refusal and LateAnswer name the order by it. 0 means no number.
  std::uint64_t number = 0;
};

/// Requests that no call waits for.
enum class RefusedRequest { kJoints, kSpeedLimits, kWalk, kLeds, kEars, kMicrophone };

/// Why such a request is not carried out, or not carried on. New causes may be added at the end.
enum class RefusalCause {
  kRobot,      ///< the robot has refused the request
  kTooOld,     ///< the request could not be sent until OrderTerms::not_after
  kStopped,    ///< hold(), takePosture(), playMotion() or the motors' switch came before it was sent
  kReplaced,   ///< a walk or a command to the legs took the legs before the request was sent
  kJointFault  ///< a joint does not follow its commands: the robot holds it where it is
};

/// Reports that a request that no call waits for was refused, or was dropped before it was sent.
struct Refusal {
  RefusedRequest request = RefusedRequest::kJoints;
  RefusalCause cause = RefusalCause::kRobot;
  std::vector<int> ids;     ///< the ids of the joints, LEDs or ears concerned; empty for a walk
  std::string reason;       ///< the reason in words for the user, without a full stop
  std::uint64_t order = 0;  ///< OrderTerms::number; 0 if there is no order, or several, or if it is unknown
};

/// The robot's answer to a call that had ended with a TimeoutException.
struct LateAnswer {
  std::uint64_t order = 0;  ///< OrderTerms::number
  bool accepted = false;    ///< true: the robot has begun; false: it has refused
  std::string reason;       ///< why the robot has refused, in a sentence for the user; empty if it has not refused
  std::string changes;      ///< what playMotion() would have returned
};

}  // namespace aibo_client

#endif  // AIBO_CLIENT_ORDERS_H
