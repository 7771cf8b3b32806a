#include "physical_ers7.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "simulator/ers7/body/joints.h"
#include "simulator/ers7/body/sensor_frame_writer.h"
#include "simulator/ers7/body/stance.h"
#include "simulator/openr_host/clock.h"

namespace physics {
namespace {

using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using robot_model::Leg;
using simulated_ers7::PrimitiveKind;

constexpr double kDegree = 3.14159265358979323846 / 180;
constexpr int kStepsPerFrame = 4;
static_assert(kStepsPerFrame * kStepSeconds == openr_host::kFrameSeconds, "a frame is a whole number of steps");

/// Full duty at this many frames behind, as in simulator/ers7/body/joint.h.
constexpr double kFramesToFullDuty = 3;

/// Friction of the gears of a joint without current, in N m s/radian: it gives way, but does not swing. Our choice.
constexpr double kLooseFriction = 0.02;

constexpr const char* kFeet[] = {"left_front_foot_link_0", "left_hind_foot_link_0", "right_front_foot_link_0",
                                 "right_hind_foot_link_0"};
constexpr const char* kPaws[] = {"paw_left_front", "paw_left_hind", "paw_right_front", "paw_right_hind"};

const robot_model::RobotModel& ers7() {
  return *robot_model::findRobotModel("ERS-7");
}

std::vector<simulated_ers7::SensorFrameEntry> sensorFrameEntries() {
  std::vector<simulated_ers7::SensorFrameEntry> entries;
  for (int i = 0; i < ers7().number_of_joints; ++i) {
    entries.push_back({simulated_ers7::jointPrimitive(static_cast<std::size_t>(i)), odataJOINT_VALUE});
  }
  for (int i = 0; i < ers7().number_of_sensors; ++i) {
    if (ers7().sensors[i].locator != nullptr) {
      entries.push_back({simulated_ers7::sensorPrimitive(static_cast<std::size_t>(i)), odataNO_DIMENSION});
    }
  }
  return entries;
}

int microradian(double angle) {
  return static_cast<int>(std::lround(angle * 1e6));
}

robot_model::LegAngles anglesOf(Leg leg, const std::function<double(std::size_t)>& position) {
  const std::size_t first = 4 + 3 * leg;  // in the robot's table
  return {position(first), position(first + 1), position(first + 2)};
}

}  // namespace

PhysicalErs7::PhysicalErs7(const World& world)
    : model_(ers7()),
      world_(world),
      physics_(compile(describeBody(ERS7_URDF, world))),
      state_(mj_makeData(physics_.get())),
      body_(mj_name2id(physics_.get(), mjOBJ_BODY, "base_link")),
      primitives_(model_),
      sensors_(static_cast<std::size_t>(model_.number_of_sensors)),
      regions_(simulated_ers7::sensorFramesSize(sensorFrameEntries().size()),
               [](RCRegion* region) { simulated_ers7::prepareSensorFrames(region, sensorFrameEntries()); }) {
  JointAngles posture;
  for (int i = 0; i < model_.number_of_joints; ++i) {
    const char* name = model_.joints[i].name;
    const int joint = mj_name2id(physics_.get(), mjOBJ_JOINT, name);
    Servo servo{};
    servo.position_address = physics_->jnt_qposadr[joint];
    servo.speed_address = physics_->jnt_dofadr[joint];
    servo.motor = mj_name2id(physics_.get(), mjOBJ_ACTUATOR, name);
    servos_.push_back(servo);
    posture[name] = simulated_ers7::restingPosition(name) * 1e-6 / kDegree;
  }
  for (std::size_t leg = 0; leg < feet_.size(); ++leg) {
    feet_[leg] = mj_name2id(physics_.get(), mjOBJ_GEOM, kFeet[leg]);
  }
  place(posture);
}

void PhysicalErs7::place(const JointAngles& angles, const Quaterniond& turn) {
  for (std::size_t i = 0; i < servos_.size(); ++i) {
    const auto position = angles.find(model_.joints[i].name);
    if (position != angles.end()) {
      state_->qpos[servos_[i].position_address] = position->second * kDegree;
    }
    servos_[i].reference = jointPosition(i);
  }
  std::fill_n(state_->qvel, physics_->nv, 0);
  std::array<robot_model::LegAngles, robot_model::NUMBER_OF_LEGS> legs;
  for (std::size_t leg = 0; leg < legs.size(); ++leg) {
    legs[leg] = anglesOf(static_cast<Leg>(leg), [this](std::size_t joint) { return jointPosition(joint); });
  }
  Isometry3d pose = simulated_ers7::standOn(legs).body;
  if (!turn.isApprox(Quaterniond::Identity())) {
    pose = Eigen::Translation3d(0, 0, 0.12) * turn;  // it drops the rest of the way
  }
  const Vector3d place = pose.translation();
  const Quaterniond direction(pose.linear());
  const double values[] = {place.x(), place.y(), place.z(), direction.w(), direction.x(), direction.y(), direction.z()};
  std::copy(std::begin(values), std::end(values), state_->qpos);
  mj_forward(physics_.get(), state_.get());
  read();
}

void PhysicalErs7::push(const Vector3d& force) {
  std::copy_n(force.data(), 3, state_->xfrc_applied + 6 * body_);
}

OStatus PhysicalErs7::forServos(OPrimitiveID id, const std::function<OStatus(std::size_t, Servo&)>& action) {
  for (std::size_t i = 0; i < servos_.size(); ++i) {
    const OPrimitiveID primitive = simulated_ers7::jointPrimitive(i);
    if (primitives_.isOpen(primitive) && (id == primitive || id == oprimitiveID_UNDEF)) {
      const OStatus status = action(i, servos_[i]);
      if (id == primitive) {
        return status;
      }
    }
  }
  return id == oprimitiveID_UNDEF ? oSUCCESS : oINVALID_PRIMITIVE_ID;
}

OStatus PhysicalErs7::setJointGain(OPrimitiveID id, word pg, word, word, word, word, word) {
  return forServos(id, [&](std::size_t joint, Servo& servo) {
    if (!servo.has_gain) {
      return oGAIN_DISABLED;
    }
    servo.stiffness = static_cast<double>(pg) / model_.joints[joint].gains.proportional;
    return oSUCCESS;
  });
}

OStatus PhysicalErs7::enableJointGain(OPrimitiveID id) {
  return forServos(id, [](std::size_t, Servo& servo) {
    servo.has_gain = true;
    return oSUCCESS;
  });
}

OStatus PhysicalErs7::disableJointGain(OPrimitiveID id) {
  return forServos(id, [](std::size_t, Servo& servo) {
    servo.has_gain = false;
    servo.stiffness = 0;
    return oSUCCESS;
  });
}

OStatus PhysicalErs7::getJointValue(OPrimitiveID id, OJointValue* value) {
  return forServos(id, [&](std::size_t, const Servo& servo) {
    *value = servo.readings.back();
    return oSUCCESS;
  });
}

OStatus PhysicalErs7::getSensorValue(OPrimitiveID id, OSensorValue* value) {
  const auto primitive = primitives_.find(id);
  if (!primitive || primitive->kind != PrimitiveKind::kSensor) {
    return oINVALID_PRIMITIVE_ID;
  }
  *value = sensors_[primitive->index].back();
  return oSUCCESS;
}

OStatus PhysicalErs7::setMotorPower(OPower power) {
  powered_ = power == opowerON;
  return oSUCCESS;
}

OStatus PhysicalErs7::getPowerStatus(OPowerStatus* status) {
  *status = battery_.status();
  status->robotStatus |= powered_ ? orsbMOTOR_POWER : 0;
  return oSUCCESS;
}

void PhysicalErs7::switchOff() {
  powered_ = false;
  disableJointGain(oprimitiveID_UNDEF);
  primitives_.close(oprimitiveID_UNDEF);
}

bool PhysicalErs7::takesCommand(OPrimitiveID id, ODataType type) const {
  const auto primitive = primitives_.find(id);
  if (!primitive) {
    return false;
  }
  const bool is_of_led = type == odataLED_COMMAND2 || type == odataLED_COMMAND3;
  return (primitive->kind == PrimitiveKind::kJoint && type == odataJOINT_COMMAND2) ||
         (primitive->kind == PrimitiveKind::kLed && is_of_led) ||
         (primitive->kind == PrimitiveKind::kEar && type == odataJOINT_COMMAND4);
}

void PhysicalErs7::passFrame(longword /*frame*/, const openr_host::EffectorCommands& commands) {
  for (const openr_host::EffectorCommand& command : commands) {
    if (command.type == odataJOINT_COMMAND2) {
      OJointCommandValue2 value;
      std::memcpy(&value, &command.value, sizeof(value));
      forServos(command.primitive, [&](std::size_t, Servo& servo) {
        servo.reference = value.value * 1e-6;
        return oSUCCESS;
      });
    }
  }
  acceleration_ = {};
  for (int i = 0; i < kStepsPerFrame; ++i) {
    driveMotors();
    mj_step(physics_.get(), state_.get());
    for (std::size_t axis = 0; axis < acceleration_.size(); ++axis) {
      acceleration_[axis] += state_->sensordata[axis] / kStepsPerFrame;
    }
  }
  battery_.passFrame();
  read();
}

void PhysicalErs7::driveMotors() {
  for (std::size_t i = 0; i < servos_.size(); ++i) {
    Servo& servo = servos_[i];
    const bool driven = powered_ && servo.has_gain;
    const double full_duty_at = kFramesToFullDuty * openr_host::kFrameSeconds * highestSpeed(i) / world_.servo_gain;
    const double duty = servo.stiffness * (servo.reference - jointPosition(i)) / full_duty_at;
    servo.duty = driven ? std::clamp(duty, -1.0, 1.0) : 0;
    state_->ctrl[servo.motor] = servo.duty * world_.stall_torque;
    // The motor's own voltage, which brakes it: MuJoCo integrates damping implicitly, so it may be strong.
    physics_->dof_damping[servo.speed_address] = driven ? world_.stall_torque / highestSpeed(i) : kLooseFriction;
  }
}

void PhysicalErs7::read() {
  for (std::size_t i = 0; i < servos_.size(); ++i) {
    OJointValue value = {};
    value.value = microradian(jointPosition(i));
    value.pwmDuty = static_cast<sword>(std::lround(servos_[i].duty * 512));
    value.refValue = microradian(servos_[i].reference);
    auto& readings = servos_[i].readings;
    std::rotate(readings.begin(), readings.begin() + 1, readings.end());
    readings.back() = value;
  }
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    std::rotate(sensors_[i].begin(), sensors_[i].begin() + 1, sensors_[i].end());
    sensors_[i].back() = {measure(model_.sensors[i]), 0, {}};
  }
}

int PhysicalErs7::measure(const robot_model::Sensor& sensor) const {
  const std::string name = sensor.name;
  // Sony's signs: gravity minus acceleration, along forward, right and up. MuJoCo's are the opposite, with left.
  if (name == "acceleration_front_back") {
    return microradian(-acceleration_[0]);
  }
  if (name == "acceleration_right_left") {
    return microradian(acceleration_[1]);
  }
  if (name == "acceleration_up_down") {
    return microradian(-acceleration_[2]);
  }
  for (std::size_t leg = 0; leg < feet_.size(); ++leg) {
    if (name == kPaws[leg]) {
      return static_cast<int>(touches(feet_[leg]));
    }
  }
  return sensor.kind == robot_model::SENSOR_DISTANCE ? sensor.highest : static_cast<int>(name == "wlan_switch");
}

RCRegion* PhysicalErs7::captureSensors(longword frame) {
  RCRegion* region = regions_.freeRegion();
  std::size_t entry = 0;
  for (const Servo& servo : servos_) {
    simulated_ers7::writeSensorFrames(region, entry++, frame, servo.readings.data());
  }
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    if (model_.sensors[i].locator != nullptr) {
      simulated_ers7::writeSensorFrames(region, entry++, frame, sensors_[i].data());
    }
  }
  return region;
}

Isometry3d PhysicalErs7::body() const {
  const double* place = state_->qpos;
  return Eigen::Translation3d(place[0], place[1], place[2]) * Quaterniond(place[3], place[4], place[5], place[6]);
}

double PhysicalErs7::tilt() const {
  return std::acos(std::clamp(body().linear()(2, 2), -1.0, 1.0));
}

double PhysicalErs7::jointPosition(std::size_t joint) const {
  return state_->qpos[servos_[joint].position_address];
}

double PhysicalErs7::jointSpeed(std::size_t joint) const {
  return state_->qvel[servos_[joint].speed_address];
}

double PhysicalErs7::duty(std::size_t joint) const {
  return servos_[joint].duty;
}

double PhysicalErs7::soleHeight(Leg leg) const {
  return state_->geom_xpos[3 * feet_[leg] + 2] - robot_model::FOOT_RADIUS;
}

bool PhysicalErs7::touchesFloor(Leg leg) const {
  return touches(feet_[leg]);
}

bool PhysicalErs7::touches(int geom) const {
  return anyContact([geom](int a, int b) { return a == geom || b == geom; });
}

bool PhysicalErs7::anyContact(const std::function<bool(int, int)>& condition) const {
  return std::any_of(state_->contact, state_->contact + state_->ncon, [&](const mjContact& contact) {
    return contact.dist < 0 && condition(contact.geom1, contact.geom2);
  });
}

bool PhysicalErs7::bodyTouchesFloor() const {
  const int floor = mj_name2id(physics_.get(), mjOBJ_GEOM, kFloor);
  return anyContact([&](int a, int b) { return a == floor && physics_->geom_contype[b] == kBodyContacts; });
}

bool PhysicalErs7::legsTouch() const {
  const auto isOfLeg = [this](int geom) { return physics_->geom_contype[geom] == kLegContacts; };
  return anyContact([&](int a, int b) { return isOfLeg(a) && isOfLeg(b); });
}

bool PhysicalErs7::motorsPull() const {
  return powered_ && std::any_of(servos_.begin(), servos_.end(), [](const Servo& servo) { return servo.has_gain; });
}

}  // namespace physics
