/// @file steering_streams.h
#ifndef AIBO_DRIVER_MOVEMENT_STEERING_STREAMS_H
#define AIBO_DRIVER_MOVEMENT_STEERING_STREAMS_H

#include <chrono>
#include <map>
#include <string>

#include "movement/movement.h"

namespace aibo_driver::movement {

/// The nodes that steer the robot. What a node sends without a longer pause is a stream. A stream that something has
/// overruled moves the robot again only after its node has let go: it has sent a velocity of 0, or has paused.
///
/// From one thread at a time.
class SteeringStreams {
 public:
  /// Without a velocity for this long, a stream has ended.
  static constexpr std::chrono::milliseconds kPause{500};

  /// Notes a velocity.
  /// @return what has overruled its stream; empty if it counts
  std::string receive(const Order& order, bool is_zero);

  /// All streams that go on now are overruled.
  /// @param what in words
  void overrule(const std::string& what);

  /// The same for one node's stream.
  void overrule(const std::string& node, const std::string& what);

  /// True if a node's stream goes on.
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
