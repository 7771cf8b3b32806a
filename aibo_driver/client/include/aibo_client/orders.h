/// @file orders.h
/// The terms of an order to the robot, and the client's reports of orders that were refused. motion_end.h has the ends
/// of those that were not.
#ifndef AIBO_CLIENT_ORDERS_H
#define AIBO_CLIENT_ORDERS_H

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace aibo_client {

/// How long an order may be on its way to the robot, unless its caller says otherwise. An order to move is meant for
/// now: after this time the user has seen that nothing moves. The value is our choice.
constexpr std::chrono::milliseconds kLongestOrderWait{500};

/// The terms of an order to move.
struct OrderTerms {
  /// After this time the order is too old: it is not sent any more, and a robot of version 2 that gets it later refuses
  /// it. The robot's clock counts, in frames of 8 ms. If an order has waited before it reaches the client, its caller
  /// should count from the time when it was received. Nothing that stops the robot is ever too old.
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
  kMotion,  ///< not if it has no OrderTerms::number and a call waits; that call throws in any case
  kPosture  ///< likewise
};

/// Why such a request is not carried out. New causes may be added at the end.
enum class RefusalCause {
  kRobot,    ///< the robot has refused the request
  kTooOld,   ///< it was not sent until OrderTerms::not_after or within the call's time, or it reached the robot later
  kStopped,  ///< a stop, a posture, a motion or the motors' switch came before it was sent
  kReplaced  ///< before it was sent, a later order took its joints (`ids`), or a later velocity took its place
};

/// Reports that a request was refused, or was dropped before it was sent. An order that was refused never begins.
struct Refusal {
  RefusedRequest request = RefusedRequest::kJoints;
  RefusalCause cause = RefusalCause::kRobot;
  std::vector<int> ids;     ///< the ids of the joints, LEDs or ears concerned; otherwise empty
  std::string reason;       ///< the reason in words for the user, without a full stop
  std::uint64_t order = 0;  ///< OrderTerms::number; 0 if it has none, or if the rest of the order goes on without `ids`
};

}  // namespace aibo_client

#endif  // AIBO_CLIENT_ORDERS_H
