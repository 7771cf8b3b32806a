/// @file order_gate.h
#ifndef AIBO_DRIVER_MOVEMENT_ORDER_GATE_H
#define AIBO_DRIVER_MOVEMENT_ORDER_GATE_H

#include <chrono>
#include <optional>
#include <string>

#include "movement/movement.h"

namespace aibo_driver::movement {

/// Decides which orders may act.
///
/// An order is refused if the robot is stopped, if the order has waited for too long, or if something newer overrules
/// it. So an order that waited in a queue, for whatever reason, moves nothing.
///
/// Only one thread at a time may use it.
class OrderGate {
 public:
  /// How old an order may be when it acts. The robot itself waits just as long for the next velocity of a walk.
  static constexpr std::chrono::milliseconds kLongestWait{500};

  /// Refuses all orders until release().
  /// @param node the node that stops the robot
  void stop(const std::string& node) { stopped_by_ = node; }
  void release() { stopped_by_.reset(); }

  /// The node that has stopped the robot. It is empty unless the robot is stopped.
  const std::optional<std::string>& stoppedBy() const { return stopped_by_; }

  /// Refuses the orders that were received before this time.
  /// @param what what overrules them, in words that follow "it came before"
  void overrule(SteadyTime received, const std::string& what);

  /// When the newest order was received that overrules others.
  SteadyTime overruled() const { return not_before_; }

  /// Why an order must not act now, in words that follow a colon. The text is empty if the order may act.
  /// @param may_act_while_stopped true if the order brings the robot to rest
  std::string refusal(const Order& order, SteadyTime now, bool may_act_while_stopped = false) const;

 private:
  std::optional<std::string> stopped_by_;
  SteadyTime not_before_;
  std::string overruled_by_;
};

}  // namespace aibo_driver::movement

#endif  // AIBO_DRIVER_MOVEMENT_ORDER_GATE_H
