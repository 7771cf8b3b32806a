/// @file virtual_robot_comm.h
#ifndef OPENR_HOST_OBJECTS_VIRTUAL_ROBOT_COMM_H
#define OPENR_HOST_OBJECTS_VIRTUAL_ROBOT_COMM_H

#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "openr_host/object_description.h"
#include "openr_host/objects/command_queue.h"
#include "openr_host/virtual_robot.h"

namespace openr_host {

/// The system object OVirtualRobotComm (report, section 2.1.1): the gates between the robot's body and the objects.
///
/// Its effector gate is for one commanding object. It is ready whenever one more command vector can wait, so that the
/// object sends two at first and then one for each Ready.
class VirtualRobotComm : public OObject {
 public:
  /// @param on_image called when an image is handed to the observers; may be empty
  static ObjectDescription describe(VirtualRobot& robot, const std::function<void()>& on_image);

  VirtualRobotComm(VirtualRobot& robot, std::function<void()> on_image)
      : robot_(robot), on_image_(std::move(on_image)) {}

  OStatus DoInit(const OSystemEvent& event) override;
  OStatus DoStart(const OSystemEvent& event) override;
  OStatus DoStop(const OSystemEvent& event) override;
  OStatus DoDestroy(const OSystemEvent& event) override;

  /// A frame of 8 ms has begun, and so have all since the last one that this was called for.
  void beginFrame(longword frame);

 private:
  void takeCommands(const ONotifyEvent& event);
  void askForCommands();
  void passFrame(longword frame);
  void sense(longword frame);
  void look(longword frame);

  VirtualRobot& robot_;
  const std::function<void()> on_image_;
  std::unique_ptr<OSubject> image_sensor_;
  std::unique_ptr<OSubject> sensor_;
  std::unique_ptr<OObserver> effector_;
  CommandQueue commands_;
  bool asked_for_commands_ = false;  ///< and has not got any since
  std::optional<longword> last_frame_;
};

}  // namespace openr_host

#endif  // OPENR_HOST_OBJECTS_VIRTUAL_ROBOT_COMM_H
