#include "simulator/openr_host/objects/virtual_robot_comm.h"

#include <OPENR/OSyslog.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "simulator/openr_host/objects/system.h"

namespace openr_host {
namespace {

/// The length of a vector, 32 ms (OPEN-R SDK Level2 Reference Guide). Vectors begin with the frames 0, 4, 8...
constexpr longword kFramesPerSensorVector = 4;

}  // namespace

ObjectDescription VirtualRobotComm::describe(VirtualRobot& robot) {
  ObjectDescription description;
  description.name = "OVirtualRobotComm";
  description.subjects.push_back({"OVirtualRobotComm.FbkImageSensor.OFbkImageVectorData.S", nullptr, nullptr});
  description.subjects.push_back({"OVirtualRobotComm.Sensor.OSensorFrameVectorData.S", nullptr, nullptr});
  description.observers.push_back(
      {"OVirtualRobotComm.Effector.OCommandVectorData.O",
       [](OObject& object, const OConnectEvent& event) {
         static_cast<VirtualRobotComm&>(object).effector_->AssertReady(event.SenderID());
       },
       [](OObject& object, const ONotifyEvent& event) { static_cast<VirtualRobotComm&>(object).takeCommands(event); }});
  description.create = [&robot] { return std::make_unique<VirtualRobotComm>(robot); };
  return description;
}

OStatus VirtualRobotComm::DoInit(const OSystemEvent& /*event*/) {
  System& system = System::current();
  image_sensor_ = std::make_unique<SubjectService>(system, SubjectID{myOID_, 0});
  system.add(*image_sensor_);
  sensor_ = std::make_unique<SubjectService>(system, SubjectID{myOID_, 1});
  system.add(*sensor_);
  effector_ = std::make_unique<OObserver>();
  effector_->Register(myOID_, 0);
  return oSUCCESS;
}

OStatus VirtualRobotComm::DoStop(const OSystemEvent& /*event*/) {
  effector_->DeassertReady();
  commanders_.clear();
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
  look(frame);
}

longword VirtualRobotComm::nextEvent() const {
  const longword next = last_frame_ ? *last_frame_ + 1 : 0;
  const bool has_commands = std::any_of(commanders_.begin(), commanders_.end(), [](const Commander& commander) {
    return !commander.commands.isEmpty() || commander.refused > 0;
  });
  if (has_commands || !last_frame_) {
    return next;
  }
  const longword sensors = next + (kFramesPerSensorVector - 1 - next % kFramesPerSensorVector);
  return std::min(sensors, robot_.nextCameraImage(*last_frame_));
}

void VirtualRobotComm::passFrame(longword frame) {
  EffectorCommands commands;
  std::vector<SubjectID> ready;
  for (auto& commander : commanders_) {
    const std::size_t completed = commander.commands.next(&commands) ? 1 : 0;
    ready.insert(ready.end(), completed + std::exchange(commander.refused, 0), commander.subject);
  }
  robot_.passFrame(frame, commands);
  for (const auto& subject : ready) {
    effector_->AssertReady(subject);
  }
}

// Sends sensor readings. Busy observers find the newest vector (Level2 Reference Guide, page 18).
void VirtualRobotComm::sense(longword frame) {
  if (sensor_->isWanted()) {
    has_sensed_ = true;
    sensor_->setData(robot_.captureSensors(frame));
    sensor_->notifyAll();
  }
}

// An object gets the state of the body before its first image, so that it knows the frame and the posture that belong
// to the image. The camera goes on meanwhile.
void VirtualRobotComm::look(longword frame) {
  const bool is_due = robot_.cameraImageDue(frame);
  const bool may_see = has_sensed_ || !sensor_->isObserved();
  if (is_due && may_see && image_sensor_->isWanted()) {
    image_sensor_->setData(robot_.captureImage(frame));
    image_sensor_->notifyAll();
  }
}

VirtualRobotComm::Commander& VirtualRobotComm::commander(const SubjectID& subject) {
  const auto found = std::find_if(commanders_.begin(), commanders_.end(),
                                  [&](const Commander& candidate) { return candidate.subject == subject; });
  if (found != commanders_.end()) {
    return *found;
  }
  commanders_.push_back({subject, {}, 0});
  return commanders_.back();
}

void VirtualRobotComm::takeCommands(const ONotifyEvent& event) {
  Commander& sender = commander(event.SenderID());
  for (int i = 0; i < event.NumOfData(); ++i) {
    try {
      sender.commands.add(*event.RCData(i), robot_);
    } catch (const std::invalid_argument& error) {
      // READY follows only in the next frame, so that malformed vectors cannot make an endless loop.
      ++sender.refused;
      OSYSLOG1((osyslogERROR, "command vector refused: %s", error.what()));
    }
  }
}

}  // namespace openr_host
