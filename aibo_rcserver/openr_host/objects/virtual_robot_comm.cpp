#include "openr_host/objects/virtual_robot_comm.h"

#include <OPENR/OSyslog.h>

#include <algorithm>
#include <stdexcept>

namespace openr_host {
namespace {

/// 32 ms (OPEN-R SDK Level2 Reference Guide). The vectors begin with the frames 0, 4, 8...
constexpr longword kFramesPerSensorVector = 4;

}  // namespace

ObjectDescription VirtualRobotComm::describe(VirtualRobot& robot, const std::function<void()>& on_image) {
  ObjectDescription description;
  description.name = "OVirtualRobotComm";
  description.subjects.push_back({"OVirtualRobotComm.FbkImageSensor.OFbkImageVectorData.S", nullptr, nullptr});
  description.subjects.push_back({"OVirtualRobotComm.Sensor.OSensorFrameVectorData.S", nullptr, nullptr});
  description.observers.push_back(
      {"OVirtualRobotComm.Effector.OCommandVectorData.O", nullptr,
       [](OObject& object, const ONotifyEvent& event) { static_cast<VirtualRobotComm&>(object).takeCommands(event); }});
  description.create = [&robot, on_image] { return std::make_unique<VirtualRobotComm>(robot, on_image); };
  return description;
}

OStatus VirtualRobotComm::DoInit(const OSystemEvent& /*event*/) {
  image_sensor_ = std::make_unique<OSubject>();
  image_sensor_->Register(myOID_, 0);
  sensor_ = std::make_unique<OSubject>();
  sensor_->Register(myOID_, 1);
  effector_ = std::make_unique<OObserver>();
  effector_->Register(myOID_, 0);
  return oSUCCESS;
}

OStatus VirtualRobotComm::DoStart(const OSystemEvent& /*event*/) {
  image_sensor_->Enable(true);
  sensor_->Enable(true);
  askForCommands();
  return oSUCCESS;
}

OStatus VirtualRobotComm::DoStop(const OSystemEvent& /*event*/) {
  image_sensor_->Enable(false);
  sensor_->Enable(false);
  effector_->DeassertReady();
  commands_.clear();
  return oSUCCESS;
}

OStatus VirtualRobotComm::DoDestroy(const OSystemEvent& /*event*/) {
  image_sensor_.reset();
  sensor_.reset();
  effector_.reset();
  return oSUCCESS;
}

void VirtualRobotComm::beginFrame(longword frame) {
  const longword passed = last_frame_ ? std::min(frame - *last_frame_, kMostFramesCaughtUp) : 1;
  last_frame_ = frame;
  const longword since_sensors = (frame + 1) % kFramesPerSensorVector;
  for (longword left = passed; left > 0; --left) {
    passFrame(frame - (left - 1));
    if (left - 1 == since_sensors) {
      sense(frame - since_sensors);
    }
  }
  if (commands_.hasRoom() && !asked_for_commands_) {
    askForCommands();
  }
  look(frame);
}

void VirtualRobotComm::passFrame(longword frame) {
  robot_.passFrame(frame, commands_.next());
}

void VirtualRobotComm::sense(longword frame) {
  if (sensor_->IsAnyReady()) {
    sensor_->SetData(robot_.captureSensors(frame));
    sensor_->NotifyObservers();
  }
}

void VirtualRobotComm::look(longword frame) {
  if (robot_.cameraImageDue(frame) && image_sensor_->IsAnyReady()) {
    image_sensor_->SetData(robot_.captureImage(frame));
    if (on_image_) {
      on_image_();
    }
    image_sensor_->NotifyObservers();
  }
}

void VirtualRobotComm::takeCommands(const ONotifyEvent& event) {
  asked_for_commands_ = false;
  try {
    for (int i = 0; i < event.NumOfData(); ++i) {
      commands_.add(*event.RCData(i), robot_);
    }
  } catch (const std::invalid_argument& error) {
    // The next one is asked for in the next frame only, so that an object that knows no better cannot send such without
    // end.
    OSYSLOG1((osyslogERROR, "command vector refused: %s", error.what()));
    return;
  }
  if (commands_.hasRoom()) {
    askForCommands();
  }
}

void VirtualRobotComm::askForCommands() {
  asked_for_commands_ = true;
  effector_->AssertReady();
}

}  // namespace openr_host
