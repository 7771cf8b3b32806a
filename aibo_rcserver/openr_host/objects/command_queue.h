/// @file command_queue.h
#ifndef OPENR_HOST_OBJECTS_COMMAND_QUEUE_H
#define OPENR_HOST_OBJECTS_COMMAND_QUEUE_H

#include <deque>

#include "openr_host/objects/regions.h"
#include "openr_host/virtual_robot.h"

namespace openr_host {

/// The command vectors of OVirtualRobotComm.Effector: the one that is played, one frame of 8 ms after the other, and
/// the one that waits to follow it without a gap.
class CommandQueue {
 public:
  static constexpr std::size_t kMostVectors = 2;

  bool hasRoom() const { return vectors_.size() < kMostVectors; }

  /// Takes over what a vector commands, and keeps a reference to its region until its last frame has been played.
  /// @throw std::invalid_argument if the vector is malformed or one too many; the text says what is wrong
  void add(RCRegion& region, const VirtualRobot& robot);

  /// What is commanded in the next frame. An entry with fewer frames than others of its vector commands nothing in the
  /// rest of them.
  EffectorCommands next();

  void clear() { vectors_.clear(); }

 private:
  struct Vector {
    RegionReference region;
    std::deque<EffectorCommands> frames;  ///< left to be played
  };

  std::deque<Vector> vectors_;
};

}  // namespace openr_host

#endif  // OPENR_HOST_OBJECTS_COMMAND_QUEUE_H
