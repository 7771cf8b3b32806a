#include "simulator/ers7/simulated_ers7.h"

#include <OPENR/OSyslog.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "robot_model/robot_model.h"
#include "simulator/ers7/body/sensor_frame_writer.h"
#include "simulator/ers7/camera/photographs.h"
#include "simulator/ers7/camera/scene_view.h"
#include "simulator/openr_host/clock.h"

namespace simulated_ers7 {
namespace {

const robot_model::RobotModel& modelOf(const std::string& design) {
  const robot_model::RobotModel* const model = robot_model::findRobotModel(design.c_str());
  if (model == nullptr) {
    throw std::invalid_argument("there is no simulated " + design + "; there are ERS-7 and ERS-210");
  }
  return *model;
}

ODataType typeOf(robot_model::SensorKind kind) {
  switch (kind) {
    case robot_model::SENSOR_DISTANCE:
      return odataLENGTH;
    case robot_model::SENSOR_ACCELERATION:
      return odataACCELERATION;
    case robot_model::SENSOR_FORCE:
      return odataFORCE;
    case robot_model::SENSOR_TEMPERATURE:
      return odataTEMPERATURE;
    case robot_model::SENSOR_SWITCH:
      return odataSWITCH;
    case robot_model::SENSOR_TOUCH:
    case robot_model::SENSOR_CHARGE:
      break;
  }
  return odataNO_DIMENSION;
}

/// The entries of a sensor frame: the joints, then the sensors that are primitives.
std::vector<SensorFrameEntry> sensorFrameEntries(const robot_model::RobotModel& model) {
  std::vector<SensorFrameEntry> entries;
  entries.reserve(static_cast<std::size_t>(model.number_of_joints) + static_cast<std::size_t>(model.number_of_sensors));
  for (int i = 0; i < model.number_of_joints; ++i) {
    entries.push_back({jointPrimitive(static_cast<std::size_t>(i)), odataJOINT_VALUE});
  }
  for (int i = 0; i < model.number_of_sensors; ++i) {
    if (model.sensors[i].locator != nullptr) {
      entries.push_back({sensorPrimitive(static_cast<std::size_t>(i)), typeOf(model.sensors[i].kind)});
    }
  }
  return entries;
}

template <typename Value>
Value valueOf(const openr_host::EffectorCommand& command) {
  Value value;
  static_assert(sizeof(value) == sizeof(command.value), "the types share their bytes");
  std::memcpy(&value, &command.value, sizeof(value));
  return value;
}

void obey(const openr_host::EffectorCommand& command, Led* led) {
  if (command.type == odataLED_COMMAND2) {
    led->intensity = valueOf<OLEDCommandValue2>(command).led == oledOFF ? 0 : 255;
    return;
  }
  const auto value = valueOf<OLEDCommandValue3>(command);
  led->intensity = std::clamp<int>(value.intensity, 0, 255);
  led->mode = value.mode;
}

std::unique_ptr<PictureSource> makePictures(const SimulatedErs7::Options& options, Scene& scene) {
  if (!options.images_folder.empty()) {
    return std::make_unique<PhotoShow>(options.images_folder);
  }
  return std::make_unique<SceneView>(scene, options.seed);
}

}  // namespace

SimulatedErs7::SimulatedErs7(const Options& options)
    : model_(modelOf(options.design)),
      primitives_(model_),
      joints_(model_, options.seed),
      scene_(options.on_table),
      sensors_(model_, scene_, options.seed),
      battery_(options.battery_minutes),
      leds_(static_cast<std::size_t>(model_.number_of_leds)),
      ears_(static_cast<std::size_t>(model_.number_of_ears)),
      travel_(joints_.legs(), joints_.head(), scene_.groundAt(Eigen::Vector2d::Zero())),
      sound_(options.speaker_file, options.hears_itself),
      sensor_regions_(sensorFramesSize(sensorFrameEntries(model_).size()),
                      [this](RCRegion* region) { prepareSensorFrames(region, sensorFrameEntries(model_)); }),
      pictures_(makePictures(options, scene_)),
      camera_(*pictures_, kCameraPrimitive) {}

std::string SimulatedErs7::design() const {
  return model_.design;
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
  if (id == kSpeakerPrimitive) {
    return sound_.control(request, param, param_size);
  }
  return id == kCameraPrimitive ? camera_.control(request, param, param_size) : oINVALID_ARG;
}

std::optional<OSpeakerSoundType> SimulatedErs7::soundTypeOf(OPrimitiveID id) const {
  return id == kSpeakerPrimitive && primitives_.isOpen(id) ? std::make_optional(sound_.soundType()) : std::nullopt;
}

void SimulatedErs7::hear(const std::string& file) {
  sound_.hear(file == "silence" ? std::vector<OSoundSampleStereo16>() : readWav(file));
}

OStatus SimulatedErs7::setJointGain(OPrimitiveID id, word pg, word ig, word dg, word ps, word is, word ds) {
  return forJoints(id, [&](Joint& joint) { return joint.setGains({pg, ig, dg, ps, is, ds}); });
}

OStatus SimulatedErs7::setDefaultJointGain(OPrimitiveID id) {
  return forJoints(id, [](Joint& joint) { return joint.setGains(joint.model().gains); });
}

OStatus SimulatedErs7::enableJointGain(OPrimitiveID id) {
  return forJoints(id, [](Joint& joint) {
    joint.enableGain();
    return oSUCCESS;
  });
}

OStatus SimulatedErs7::disableJointGain(OPrimitiveID id) {
  return forJoints(id, [](Joint& joint) {
    joint.disableGain();
    return oSUCCESS;
  });
}

OStatus SimulatedErs7::getJointValue(OPrimitiveID id, OJointValue* value) {
  const Joint* joint = openJoint(id);
  if (joint == nullptr) {
    return oINVALID_PRIMITIVE_ID;
  }
  if (value == nullptr) {
    return oINVALID_ARG;
  }
  *value = joint->readings().back();
  return oSUCCESS;
}

OStatus SimulatedErs7::getSensorValue(OPrimitiveID id, OSensorValue* value) {
  const auto primitive = primitives_.find(id);
  if (!primitive || primitive->kind != PrimitiveKind::kSensor) {
    return oINVALID_PRIMITIVE_ID;
  }
  if (value == nullptr) {
    return oINVALID_ARG;
  }
  *value = sensors_.readings(primitive->index).back();
  return oSUCCESS;
}

OStatus SimulatedErs7::setMotorPower(OPower power) {
  motors_powered_ = power == opowerON;
  joints_.setPower(motors_powered_);
  return oSUCCESS;
}

OStatus SimulatedErs7::getPowerStatus(OPowerStatus* status) {
  if (status == nullptr) {
    return oINVALID_ARG;
  }
  *status = battery_.status();
  status->robotStatus |= motors_powered_ ? orsbMOTOR_POWER : 0;
  status->robotStatus |= pause_pressed_ ? orsbPAUSE : 0;
  return oSUCCESS;
}

OStatus SimulatedErs7::getMemoryStickStatus(OMemoryStickStatus* status) {
  *status = stick_.status();
  return oSUCCESS;
}

OStatus SimulatedErs7::setCdtVectorData(const OCdtVectorData& tables) {
  for (longword i = 0; i < tables.vectorInfo.numData; ++i) {
    const OPrimitiveID id = tables.info[i].primitiveID;
    if (id != kCameraPrimitive || !primitives_.isOpen(id)) {
      return oINVALID_PRIMITIVE_ID;
    }
  }
  return camera_.colors().load(tables);
}

void SimulatedErs7::switchOff() {
  setMotorPower(opowerOFF);
  for (Joint& joint : joints_.all()) {
    joint.disableGain();
    joint.command(static_cast<int>(std::lround(joint.position())));
  }
  std::fill(leds_.begin(), leds_.end(), Led());
  for (Ear& ear : ears_) {
    ear.energise(false);
  }
  camera_.reset();
  sound_.reset();
  primitives_.close(oprimitiveID_UNDEF);
}

bool SimulatedErs7::takesCommand(OPrimitiveID id, ODataType type) const {
  const auto primitive = primitives_.find(id);
  if (!primitive) {
    return false;
  }
  switch (primitive->kind) {
    case PrimitiveKind::kJoint:
      return type == odataJOINT_COMMAND2;
    case PrimitiveKind::kLed:
      return type == (model_.leds[primitive->index].kind == robot_model::LED2 ? odataLED_COMMAND2 : odataLED_COMMAND3);
    case PrimitiveKind::kEar:
      return type == (model_.ears[primitive->index].kind == robot_model::EAR_JOINT3 ? odataJOINT_COMMAND3
                                                                                    : odataJOINT_COMMAND4);
    case PrimitiveKind::kCamera:
    case PrimitiveKind::kSensor:
    case PrimitiveKind::kSound:
      break;
  }
  return false;
}

void SimulatedErs7::passFrame(longword frame, const openr_host::EffectorCommands& commands) {
  for (const auto& command : commands) {
    if (takesCommand(command.primitive, command.type)) {
      obey(command);
    }
  }
  joints_.passFrame();
  scene_.setTime(frame * openr_host::kFrameSeconds);
  travel_.passFrame(joints_.legs(), joints_.head(), scene_);
  sensors_.passFrame({frame, joints_.head(), travel_.stance(), travel_.acceleration()});
  battery_.passFrame();
  passFrameOfEars();
}

void SimulatedErs7::obey(const openr_host::EffectorCommand& command) {
  const Primitive primitive = *primitives_.find(command.primitive);
  switch (primitive.kind) {
    case PrimitiveKind::kJoint:
      return joints_.all()[primitive.index].command(valueOf<OJointCommandValue2>(command).value);
    case PrimitiveKind::kLed:
      return simulated_ers7::obey(command, &leds_[primitive.index]);
    case PrimitiveKind::kEar:
      // JOINT_COMMAND3 has the state at the same offset.
      return ears_[primitive.index].energise(valueOf<OJointCommandValue4>(command).value == ojoint4_STATE1);
    case PrimitiveKind::kCamera:
    case PrimitiveKind::kSensor:
    case PrimitiveKind::kSound:
      break;
  }
}

void SimulatedErs7::passFrameOfEars() {
  for (std::size_t i = 0; i < ears_.size(); ++i) {
    if (ears_[i].passFrame()) {
      OSYSLOG1((osyslogWARNING, "%s was energised for %d ms without a pause and is too hot now: release it",
                model_.ears[i].name, static_cast<int>(8 * Ear::kMostFramesEnergised)));
    }
  }
}

void SimulatedErs7::press(const std::string& button, bool pressed) {
  if (button == kPauseButton) {
    pause_pressed_ = pressed;
  } else {
    sensors_.press(button, pressed);
  }
}

const Led& SimulatedErs7::led(const std::string& name) const {
  const int index = robot_model::findLedByName(model_, name.c_str());
  if (index == robot_model::NO_LED) {
    throw std::invalid_argument("the " + design() + " has no LED \"" + name + "\"");
  }
  return leds_[static_cast<std::size_t>(index)];
}

const Ear& SimulatedErs7::ear(const std::string& name) const {
  const int index = robot_model::findEarByName(model_, name.c_str());
  if (index == robot_model::NO_EAR) {
    throw std::invalid_argument("the " + design() + " has no ear \"" + name + "\"");
  }
  return ears_[static_cast<std::size_t>(index)];
}

RCRegion* SimulatedErs7::captureSensors(longword frame) {
  RCRegion* region = sensor_regions_.freeRegion();
  std::size_t entry = 0;
  for (const Joint& joint : joints_.all()) {
    writeSensorFrames(region, entry++, frame, joint.readings().data());
  }
  for (int i = 0; i < model_.number_of_sensors; ++i) {
    if (model_.sensors[i].locator != nullptr) {
      writeSensorFrames(region, entry++, frame, sensors_.readings(static_cast<std::size_t>(i)).data());
    }
  }
  return region;
}

OStatus SimulatedErs7::forJoints(OPrimitiveID id, const std::function<OStatus(Joint&)>& action) {
  if (id != oprimitiveID_UNDEF) {
    Joint* joint = openJoint(id);
    return joint != nullptr ? action(*joint) : oINVALID_PRIMITIVE_ID;
  }
  OStatus status = oSUCCESS;
  for (std::size_t i = 0; i < joints_.all().size(); ++i) {
    Joint* joint = openJoint(jointPrimitive(i));
    const OStatus result = joint != nullptr ? action(*joint) : oSUCCESS;
    status = result == oSUCCESS ? status : result;
  }
  return status;
}

Joint* SimulatedErs7::openJoint(OPrimitiveID id) {
  const auto primitive = primitives_.find(id);
  return primitive && primitive->kind == PrimitiveKind::kJoint ? &joints_.all()[primitive->index] : nullptr;
}

bool SimulatedErs7::cameraImageDue(longword frame) {
  return camera_.imageDue(frame);
}

RCRegion* SimulatedErs7::captureImage(longword frame) {
  return camera_.capture(frame, {joints_.head(), travel_.stance().body});
}

}  // namespace simulated_ers7
