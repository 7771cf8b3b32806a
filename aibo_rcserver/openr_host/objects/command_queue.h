/// @file command_queue.h
#ifndef OPENR_HOST_OBJECTS_COMMAND_QUEUE_H
#define OPENR_HOST_OBJECTS_COMMAND_QUEUE_H

#include <deque>
#include <vector>

#include "openr_host/objects/regions.h"
#include "openr_host/virtual_robot.h"

namespace openr_host {

/// The command vectors that one object has sent to OVirtualRobotComm.Effector: the one that is output, one frame of
/// 8 ms after the other, and those that follow it without a gap.
///
/// Values are read when they are output: an object that writes to a vector before its region is free again
/// (RCRegion::NumberOfReference()) changes what the joints do, as on the robot.
class CommandQueue {
 public:
  /// Checks a vector, and keeps a reference to its region until its last frame has been output.
  /// @throw std::invalid_argument if the vector is malformed; the text says what is wrong
  void add(RCRegion& region, const VirtualRobot& robot);

  /// Adds the next frame's commands to those of other objects. An entry with fewer frames than others of its vector
  /// commands nothing in the rest of them.
  /// @return true if this was the last frame of a vector: its region is free now
  bool next(EffectorCommands* commands);

 private:
  struct Vector {
    RegionReference region;
    std::vector<OCommandInfo> entries;
    std::size_t frame = 0;  ///< that is output next
  };

  std::deque<Vector> vectors_;
};

}  // namespace openr_host

#endif  // OPENR_HOST_OBJECTS_COMMAND_QUEUE_H
