#include "simulated_ers7/simulated_ers7.h"

#include <cstring>

#include "robot_model/robot_model.h"
#include "simulated_ers7/photo_show.h"
#include "simulated_ers7/scene_view.h"
#include "simulated_ers7/sensor_frame_writer.h"

namespace simulated_ers7 {
namespace {

const robot_model::RobotModel& model() {
  return *robot_model::findRobotModel("ERS-7");
}

std::vector<OPrimitiveID> jointPrimitives() {
  std::vector<OPrimitiveID> primitives;
  primitives.reserve(static_cast<std::size_t>(model().number_of_joints));
  for (int i = 0; i < model().number_of_joints; ++i) {
    primitives.push_back(jointPrimitive(static_cast<std::size_t>(i)));
  }
  return primitives;
}

std::unique_ptr<PictureSource> makePictures(const SimulatedErs7::Options& options, Scene& scene) {
  if (!options.images_folder.empty()) {
    return std::make_unique<PhotoShow>(options.images_folder, options.seconds_per_image);
  }
  return std::make_unique<SceneView>(scene, options.seed);
}

}  // namespace

SimulatedErs7::SimulatedErs7(const Options& options)
    : primitives_(model()),
      joints_(model(), options.seed),
      sensor_regions_(sensorFramesSize(joints_.all().size()),
                      [](RCRegion* region) { prepareSensorFrames(region, jointPrimitives()); }),
      pictures_(makePictures(options, scene_)),
      camera_(*pictures_, kCameraPrimitive) {}

std::string SimulatedErs7::design() const {
  return model().design;
}

OStatus SimulatedErs7::openPrimitive(const char* locator, OPrimitiveID* id) {
  return primitives_.open(locator, id);
}

OStatus SimulatedErs7::closePrimitive(OPrimitiveID id) {
  return primitives_.close(id);
}

OStatus SimulatedErs7::controlPrimitive(OPrimitiveID id, OPrimitiveRequest request, void* param, size_t param_size,
                                        void* /*result*/, size_t /*result_size*/) {
  if (!primitives_.isOpen(id)) {
    return oINVALID_PRIMITIVE_ID;
  }
  return id == kCameraPrimitive ? camera_.control(request, param, param_size) : oINVALID_ARG;
}

OStatus SimulatedErs7::setJointGain(OPrimitiveID id, word pg, word ig, word dg, word ps, word is, word ds) {
  return forJoints(id, [&](Joint& joint) {
    joint.setGains({pg, ig, dg, ps, is, ds});
    return oSUCCESS;
  });
}

OStatus SimulatedErs7::enableJointGain(OPrimitiveID id) {
  return forJoints(id, [](Joint& joint) { return joint.enableGain(); });
}

OStatus SimulatedErs7::disableJointGain(OPrimitiveID id) {
  return forJoints(id, [](Joint& joint) {
    joint.disableGain();
    return oSUCCESS;
  });
}

OStatus SimulatedErs7::getJointValue(OPrimitiveID id, OJointValue* value) {
  if (!isOpenJoint(id)) {
    return oINVALID_PRIMITIVE_ID;
  }
  if (value == nullptr) {
    return oINVALID_ARG;
  }
  *value = joint(id).readings().back();
  return joint(id).status();
}

OStatus SimulatedErs7::getSensorValue(OPrimitiveID /*id*/, OSensorValue* /*value*/) {
  return oINVALID_PRIMITIVE_ID;
}

OStatus SimulatedErs7::setMotorPower(OPower power) {
  joints_.setPower(power == opowerON);
  return oSUCCESS;
}

OStatus SimulatedErs7::getPowerStatus(OPowerStatus* status) {
  *status = OPowerStatus();
  status->robotStatus = orsbBATTERY_CONNECTED | orsbMOTOR_POWER;
  status->remainingCapacity = 100;
  return oSUCCESS;
}

void SimulatedErs7::switchOff() {
  joints_.setPower(false);
  forJoints(oprimitiveID_UNDEF, [](Joint& joint) {
    joint.disableGain();
    return oSUCCESS;
  });
  primitives_.close(oprimitiveID_UNDEF);
}

bool SimulatedErs7::takesCommand(OPrimitiveID id, ODataType type) const {
  return type == odataJOINT_COMMAND2 && isOpenJoint(id);
}

void SimulatedErs7::passFrame(longword /*frame*/, const openr_host::EffectorCommands& commands) {
  for (const auto& command : commands) {
    if (takesCommand(command.primitive, command.type)) {
      OJointCommandValue2 value;
      static_assert(sizeof(value) == sizeof(command.value), "one is laid over the other");
      std::memcpy(&value, &command.value, sizeof(value));
      joint(command.primitive).command(value.value);
    }
  }
  joints_.passFrame();
}

RCRegion* SimulatedErs7::captureSensors(longword frame) {
  RCRegion* region = sensor_regions_.freeRegion();
  writeSensorFrames(region, frame, joints_.all());
  return region;
}

OStatus SimulatedErs7::forJoints(OPrimitiveID id, const std::function<OStatus(Joint&)>& action) {
  if (id != oprimitiveID_UNDEF) {
    return isOpenJoint(id) ? action(joint(id)) : oINVALID_PRIMITIVE_ID;
  }
  OStatus status = oSUCCESS;
  for (const OPrimitiveID one : jointPrimitives()) {
    const OStatus result = isOpenJoint(one) ? action(joint(one)) : oSUCCESS;
    status = result == oSUCCESS ? status : result;
  }
  return status;
}

bool SimulatedErs7::isOpenJoint(OPrimitiveID id) const {
  return primitives_.isOpen(id) && id != kCameraPrimitive;
}

bool SimulatedErs7::cameraImageDue(longword frame) {
  return camera_.imageDue(frame);
}

RCRegion* SimulatedErs7::captureImage(longword frame) {
  pictures_->setHead(joints_.head());
  return camera_.capture(frame);
}

}  // namespace simulated_ers7
