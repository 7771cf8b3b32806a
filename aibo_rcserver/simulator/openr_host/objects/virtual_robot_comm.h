/// @file virtual_robot_comm.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_VIRTUAL_ROBOT_COMM_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_VIRTUAL_ROBOT_COMM_H

#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>

#include <memory>
#include <optional>
#include <vector>

#include "simulator/openr_host/object_description.h"
#include "simulator/openr_host/objects/command_queue.h"
#include "simulator/openr_host/objects/gates.h"
#include "simulator/openr_host/virtual_robot.h"

namespace openr_host {

/// The system object OVirtualRobotComm: gates between the robot's body and the objects (Level2 Reference Guide, page
/// 44).
///
/// Any number of objects may command the body at the same time, each with its own primitives. An object gets READY
/// whenever one of its vectors is complete, and first when it is connected. To avoid gaps, an object first sends two
/// vectors, and then one for each READY.
class VirtualRobotComm : public OObject {
 public:
  static ObjectDescription describe(VirtualRobot& robot);

  explicit VirtualRobotComm(VirtualRobot& robot) : robot_(robot) {}

  OStatus DoInit(const OSystemEvent& event) override;
  OStatus DoStop(const OSystemEvent& event) override;
  OStatus DoDestroy(const OSystemEvent& event) override;

  /// Call this when a frame of 8 ms has begun. Frames since the last call are made up for.
  void beginFrame(longword frame);

  /// The next frame with something for objects: sensors, an image, or READY for a command vector. Earlier frames may
  /// pass together with it. It is at most 32 ms away, so that changes of the power are noticed.
  longword nextEvent() const;

 private:
  /// An object that commands the body.
  struct Commander {
    SubjectID subject;
    CommandQueue commands;
    std::size_t refused = 0;  ///< number of refused vectors for which the object gets READY in the next frame
  };

  Commander& commander(const SubjectID& subject);
  void takeCommands(const ONotifyEvent& event);
  void passFrame(longword frame);
  void sense(longword frame);
  void look(longword frame);

  VirtualRobot& robot_;
  std::unique_ptr<SubjectService> image_sensor_;
  std::unique_ptr<SubjectService> sensor_;
  std::unique_ptr<OObserver> effector_;
  std::vector<Commander> commanders_;
  std::optional<longword> last_frame_;
  bool has_sensed_ = false;  ///< an object has got sensor readings
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_VIRTUAL_ROBOT_COMM_H
