#include "openr_host/objects/virtual_robot_comm.h"

namespace openr_host {

ObjectDescription VirtualRobotComm::describe(VirtualRobot& robot, const std::function<void()>& on_image) {
  ObjectDescription description;
  description.name = "OVirtualRobotComm";
  description.subjects.push_back({"OVirtualRobotComm.FbkImageSensor.OFbkImageVectorData.S", nullptr, nullptr});
  description.create = [&robot, on_image] { return std::make_unique<VirtualRobotComm>(robot, on_image); };
  return description;
}

OStatus VirtualRobotComm::DoInit(const OSystemEvent& /*event*/) {
  image_sensor_ = std::make_unique<OSubject>();
  image_sensor_->Register(myOID_, 0);
  return oSUCCESS;
}

OStatus VirtualRobotComm::DoStart(const OSystemEvent& /*event*/) {
  image_sensor_->Enable(true);
  return oSUCCESS;
}

OStatus VirtualRobotComm::DoStop(const OSystemEvent& /*event*/) {
  image_sensor_->Enable(false);
  return oSUCCESS;
}

OStatus VirtualRobotComm::DoDestroy(const OSystemEvent& /*event*/) {
  image_sensor_.reset();
  return oSUCCESS;
}

void VirtualRobotComm::beginFrame(longword frame) {
  if (robot_.cameraImageDue(frame) && image_sensor_->IsAnyReady()) {
    image_sensor_->SetData(robot_.captureImage(frame));
    if (on_image_) {
      on_image_();
    }
    image_sensor_->NotifyObservers();
  }
}

}  // namespace openr_host
