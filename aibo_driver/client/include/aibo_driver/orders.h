/// @file orders.h
/// What goes with an order to the robot, and what the client tells about one that was not carried out.
#ifndef AIBO_DRIVER_ORDERS_H
#define AIBO_DRIVER_ORDERS_H

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace aibo_driver {

/// How long an order may wait before it is sent, unless its caller says otherwise. An order to move is meant for now:
/// after this time its user has seen that nothing moves (our choice).
constexpr std::chrono::milliseconds kLongestOrderWait{500};

/// What goes with an order to move.
struct OrderTerms {
  /// After this time the order is too old and is not sent any more. A caller whose order has waited before it reaches
  /// the client counts from when it was received.
  std::chrono::steady_clock::time_point not_after = std::chrono::steady_clock::now() + kLongestOrderWait;
  /// A number of the caller's choice, by which Refusal and LateAnswer name the order. 0 = none.
  std::uint64_t number = 0;
};

/// Requests that nobody waits for.
enum class RefusedRequest { kJoints, kSpeedLimits, kWalk, kLeds, kEars };

/// Why one of them is not carried out, or not any more. New causes may be added at the end.
enum class RefusalCause {
  kRobot,      ///< the robot has refused it
  kTooOld,     ///< it could not be sent until OrderTerms::not_after
  kStopped,    ///< hold(), takePosture(), playMotion() or the motors' switch came before it was sent
  kReplaced,   ///< a walk, or a command to the legs, took the legs before it was sent
  kJointFault  ///< a joint does not follow its commands: the robot holds it where it is
};

/// A request that nobody waits for was refused, or was dropped before it was sent.
struct Refusal {
  RefusedRequest request = RefusedRequest::kJoints;
  RefusalCause cause = RefusalCause::kRobot;
  std::vector<int> ids;     ///< of the joints, LEDs or ears concerned; empty for a walk
  std::string reason;       ///< in words for the user, without a full stop
  std::uint64_t order = 0;  ///< OrderTerms::number; 0 = none, or several, or not known
};

/// The robot's answer to a call that had ended with a TimeoutException.
struct LateAnswer {
  std::uint64_t order = 0;  ///< OrderTerms::number
  bool accepted = false;    ///< the robot has begun; else it has refused
  std::string reason;       ///< why it has refused, in a sentence for the user; empty if it has not
  std::string changes;      ///< what playMotion() would have returned
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_ORDERS_H
