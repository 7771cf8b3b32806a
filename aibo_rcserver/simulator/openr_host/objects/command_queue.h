/// @file command_queue.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_COMMAND_QUEUE_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_COMMAND_QUEUE_H

#include <deque>
#include <vector>

#include "simulator/openr_host/objects/gates.h"
#include "simulator/openr_host/virtual_robot.h"

namespace openr_host {

/// The command vectors that one object has sent to OVirtualRobotComm.Effector: the one that is being output, one frame
/// of 8 ms at a time, and those that follow it without a gap.
///
/// Values are read when they are output. So an object that writes to a vector before its region is free again
/// (RCRegion::NumberOfReference()) changes the movement, as on the robot.
class CommandQueue {
 public:
  /// Checks a vector, and keeps a reference to its region until its last frame has been output.
  /// @throw std::invalid_argument if the vector is malformed; the text says why
  void add(RCRegion& region, const VirtualRobot& robot);

  /// Adds the next frame's commands to those of other objects. An entry with fewer frames than others in its vector
  /// commands nothing in the remaining ones. A value that lasts several frames is commanded in the first of them. A
  /// vector can be delayed by its header (Level2 Reference Guide, pages 45 to 50).
  /// @return true if this was the last frame of a vector, whose region is now free
  bool next(EffectorCommands* commands);

  /// True if there is nothing to output.
  bool isEmpty() const { return vectors_.empty(); }

 private:
  struct Entry {
    OCommandInfo info;
    std::size_t next_value;
    longword frames_left;  ///< of the current value
  };

  struct Vector {
    RegionReference region;
    std::vector<Entry> entries;
    longword frames_to_wait;
  };

  /// @return true if the entry has more to output in a later frame
  static bool output(const RCRegion& region, Entry* entry, EffectorCommands* commands);

  std::deque<Vector> vectors_;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_COMMAND_QUEUE_H
