/// @file steering_streams.h
#ifndef AIBO_DRIVER_MOVEMENT_STEERING_STREAMS_H
#define AIBO_DRIVER_MOVEMENT_STEERING_STREAMS_H

#include <chrono>
#include <map>
#include <string>

#include "movement/movement.h"

namespace aibo_driver::movement {

/// The nodes that steer the robot. Velocities that a node sends with no pause longer than kPause are a stream. A stream
/// counts only if it began after everything that overrules streams. So a node that was overruled has to let go before
/// it can move the robot again: it has to send a velocity of 0, or pause.
///
/// Only one thread at a time may use an object of this class.
class SteeringStreams {
 public:
  /// The pause in a node's velocities after which its stream has ended.
  static constexpr std::chrono::milliseconds kPause{500};

  /// Notes a velocity. The time for which this process stalled is not a pause of the node.
  /// @param now when the velocity is read
  /// @return what has overruled the velocity's stream; empty if the velocity counts
  std::string receive(const Order& order, bool is_zero, SteadyTime now);

  /// Overrules all streams that have begun.
  /// @param what what overrules them, in words
  void overrule(SteadyTime now, const std::string& what);

  /// True if the stream of a node goes on.
  bool goesOn(const std::string& node, SteadyTime now) const;

 private:
  struct Stream {
    SteadyTime began;
    SteadyTime last;
  };

  std::map<std::string, Stream> streams_;  ///< by node
  SteadyTime overruled_;                   ///< when streams were last overruled
  std::string overruled_by_;
};

}  // namespace aibo_driver::movement

#endif  // AIBO_DRIVER_MOVEMENT_STEERING_STREAMS_H
