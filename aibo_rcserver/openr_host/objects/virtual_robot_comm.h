/// @file virtual_robot_comm.h
#ifndef OPENR_HOST_OBJECTS_VIRTUAL_ROBOT_COMM_H
#define OPENR_HOST_OBJECTS_VIRTUAL_ROBOT_COMM_H

#include <OPENR/OObject.h>
#include <OPENR/OSubject.h>

#include <functional>
#include <memory>
#include <utility>

#include "openr_host/object_description.h"
#include "openr_host/virtual_robot.h"

namespace openr_host {

/// The system object OVirtualRobotComm (report, section 2.1.1): the gates between the robot's body and the objects.
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

  /// A frame of 8 ms has begun.
  void beginFrame(longword frame);

 private:
  VirtualRobot& robot_;
  const std::function<void()> on_image_;
  std::unique_ptr<OSubject> image_sensor_;
};

}  // namespace openr_host

#endif  // OPENR_HOST_OBJECTS_VIRTUAL_ROBOT_COMM_H
