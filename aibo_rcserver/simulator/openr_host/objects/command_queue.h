/// @file command_queue.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_COMMAND_QUEUE_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_COMMAND_QUEUE_H

#include <deque>
#include <set>
#include <utility>
#include <vector>

#include "simulator/openr_host/objects/gates.h"
#include "simulator/openr_host/virtual_robot.h"

namespace openr_host {

/// Command vectors from one object to OVirtualRobotComm.Effector. The first vector is being output, a frame of 8 ms at
/// a time. The other vectors follow without a gap.
///
/// Values are read when they are output. So, as on the robot, an object that writes to a vector before its region is
/// free (RCRegion::NumberOfReference()) changes the movement.
class CommandQueue {
 public:
  /// Checks a vector, and keeps a reference to its region until its last frame is output. An entry of a type that its
  /// primitive does not take is ignored, and logged once; Sony's own player of motions sends such entries.
  /// @throw std::invalid_argument the vector is malformed; the text says why
  void add(RCRegion& region, const VirtualRobot& robot);

  /// Adds the commands of the next frame. An entry with fewer frames than others commands nothing in the remaining
  /// ones. A value that lasts several frames is commanded in the first one. A vector's header can delay it (Level2
  /// Reference Guide, pages 45 to 50).
  /// @return true after the last frame of a vector, whose region is then free
  bool next(EffectorCommands* commands);

  bool isEmpty() const { return vectors_.empty(); }

 private:
  struct Entry {
    OCommandInfo info;
    std::size_t next_value;
    longword frames_left;  ///< frames for the present value
  };

  struct Vector {
    RegionReference region;
    std::vector<Entry> entries;
    longword frames_to_wait;
  };

  /// @return true if the entry goes on in a later frame
  static bool output(const RCRegion& region, Entry* entry, EffectorCommands* commands);

  std::vector<OCommandInfo> readEntries(const RCRegion& region, const VirtualRobot& robot);
  bool isTaken(const OCommandInfo& info, const VirtualRobot& robot);

  std::deque<Vector> vectors_;
  std::set<std::pair<OPrimitiveID, ODataType>> ignored_;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_COMMAND_QUEUE_H
