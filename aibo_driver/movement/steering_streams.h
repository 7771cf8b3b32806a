/// @file steering_streams.h
#ifndef AIBO_DRIVER_MOVEMENT_STEERING_STREAMS_H
#define AIBO_DRIVER_MOVEMENT_STEERING_STREAMS_H

#include <chrono>
#include <map>
#include <string>

#include "movement/movement.h"

namespace aibo_driver::movement {

/// The nodes that steer the robot. The velocities that a node sends without a longer pause are a stream. If something
/// overrules a stream, its node has to let go before it can move the robot again: it has to send a velocity of 0, or
/// pause.
///
/// Only one thread at a time may use it.
class SteeringStreams {
 public:
  /// A stream has ended when no velocity has come for this long.
  static constexpr std::chrono::milliseconds kPause{500};

  /// Notes a velocity.
  /// @return what has overruled the velocity's stream; empty if the velocity counts
  std::string receive(const Order& order, bool is_zero);

  /// Overrules all streams that go on now.
  /// @param what what overrules them, in words
  void overrule(const std::string& what);

  /// Overrules the stream of one node.
  void overrule(const std::string& node, const std::string& what);

  /// True if the stream of a node goes on.
  bool goesOn(const std::string& node, SteadyTime now) const;

 private:
  struct Stream {
    SteadyTime last;
    std::string overruled_by;
  };

  std::map<std::string, Stream> streams_;  ///< by node
};

}  // namespace aibo_driver::movement

#endif  // AIBO_DRIVER_MOVEMENT_STEERING_STREAMS_H
