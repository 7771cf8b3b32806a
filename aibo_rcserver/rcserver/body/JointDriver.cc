#include "rcserver/body/JointDriver.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <string.h>

#include "rcserver/body/CommandVectors.h"

using robot_model::Joint;
using robot_model::MAX_JOINTS;
using robot_model::NO_JOINT;
using robot_model::PidGains;
using robot_model::RobotModel;

namespace {

const RobotModel ROBOT_WITHOUT_JOINTS = {"", NULL, 0, NULL, 0, NULL, 0, NULL, 0, NULL, 0};

// The robot keeps two vectors at most. When it takes a third one, it has played the first.
const int VECTORS_UNTIL_ONE_IS_PLAYED = 3;

}  // namespace

JointDriver::JointDriver() : joints_(NULL), number_of_primitives_(0), state_(OFF), vectors_until_gains_(0), now_(0) {}

JointDriver::~JointDriver() {
  delete joints_;
}

void JointDriver::Open(const RobotModel& robot) {
  const bool are_open = OpenPrimitives(robot);
  if (!are_open) {
    ClosePrimitives();
  }
  joints_ = new JointControl(are_open ? robot : ROBOT_WITHOUT_JOINTS);
}

void JointDriver::Close() {
  ClosePrimitives();
  delete joints_;
  joints_ = NULL;
  state_ = OFF;
}

bool JointDriver::Switch(bool on) {
  if (on == AreOn()) {
    return true;
  }
  if (on) {
    return SwitchOn();
  }
  state_ = OFF;
  joints_->Motions().StopAll();
  for (int i = 0; i < joints_->NumberOfJoints(); ++i) {
    Check(OPENR::DisableJointGain(primitives_[i]), i, "still holds");
  }
  return true;
}

bool JointDriver::HasCommand() const {
  if (state_ == OFF) {
    return false;
  }
  if (state_ == GOING_ON || joints_->AreMoving()) {
    return true;
  }
  for (int i = 0; i < joints_->NumberOfJoints(); ++i) {
    if (joints_->Planner().Position(i) != commanded_[i]) {
      return true;
    }
  }
  return false;
}

void JointDriver::Fill(RCRegion* vector) {
  OCommandData* data[MAX_JOINTS];
  for (int i = 0; i < joints_->NumberOfJoints(); ++i) {
    data[i] = CommandVectors::Add(vector, odataJOINT_COMMAND2, primitives_[i], CommandVectors::FRAMES);
  }
  for (int frame = 0; frame < CommandVectors::FRAMES; ++frame) {
    if (state_ == ON) {
      joints_->NextFrame();
    }
    for (int i = 0; i < joints_->NumberOfJoints(); ++i) {
      commanded_[i] = joints_->Planner().Position(i);
      OJointCommandValue2 value = {commanded_[i], 0};
      memcpy(&data[i]->value[frame], &value, sizeof(value));
    }
  }
}

void JointDriver::Sent() {
  if (state_ == GOING_ON && --vectors_until_gains_ == 0) {
    EnableGains();
  }
}

bool JointDriver::ReadSensors(OSensorFrameVectorData* sensors, longword* frame) {
  bool is_any = false;
  for (int entry = 0; entry < static_cast<int>(sensors->vectorInfo.numData); ++entry) {
    const OSensorFrameInfo* info = sensors->GetInfo(entry);
    const int joint = FindPrimitive(info->primitiveID);
    if (joint == NO_JOINT || info->numFrames == 0) {
      continue;
    }
    is_any = true;
    now_ = info->frameNumber + info->numFrames - 1;
    OJointValue value;
    memcpy(&value, &sensors->GetData(entry)->frame[info->numFrames - 1], sizeof(value));
    const JointReading reading = {value.value, value.refValue, value.pwmDuty};
    Report(joint, joints_->Measured(joint, reading, now_, state_ == ON));
  }
  if (is_any) {
    *frame = now_;
  }
  return is_any;
}

// False if not all of them are open now.
bool JointDriver::OpenPrimitives(const RobotModel& robot) {
  for (int i = 0; i < robot.number_of_joints; ++i) {
    const Joint& joint = robot.joints[i];
    const OStatus status = OPENR::OpenPrimitive(joint.locator, &primitives_[i]);
    if (status != oSUCCESS) {
      OSYSLOG1((osyslogERROR, "RCServer: no joints: %s (%s) does not open (status %u)", joint.name, joint.locator,
                static_cast<unsigned>(status)));
      return false;
    }
    ++number_of_primitives_;
    const PidGains& gains = joint.gains;
    OPENR::SetJointGain(primitives_[i], gains.proportional, gains.integral, gains.derivative, gains.proportional_shift,
                        gains.integral_shift, gains.derivative_shift);
  }
  return true;
}

void JointDriver::ClosePrimitives() {
  while (number_of_primitives_ > 0) {
    --number_of_primitives_;
    OPENR::ClosePrimitive(primitives_[number_of_primitives_]);
  }
}

bool JointDriver::SwitchOn() {
  if (number_of_primitives_ == 0) {
    return false;
  }
  if (OPENR::SetMotorPower(opowerON) != oSUCCESS) {
    OSYSLOG1((osyslogERROR, "RCServer: there is no power for the motors"));
    return false;
  }
  if (!HoldPresentPositions()) {
    return false;
  }
  state_ = GOING_ON;
  vectors_until_gains_ = VECTORS_UNTIL_ONE_IS_PLAYED;
  return true;
}

bool JointDriver::HoldPresentPositions() {
  for (int i = 0; i < joints_->NumberOfJoints(); ++i) {
    OJointValue value;
    if (!Check(OPENR::GetJointValue(primitives_[i], &value), i, "does not say where it is, so the motors stay off")) {
      return false;
    }
    joints_->Hold(i, value.value, now_);
  }
  return true;
}

void JointDriver::EnableGains() {
  for (int i = 0; i < joints_->NumberOfJoints(); ++i) {
    Check(OPENR::EnableJointGain(primitives_[i]), i, "does not hold");
  }
  state_ = ON;
}

int JointDriver::FindPrimitive(OPrimitiveID primitive) const {
  for (int i = 0; i < number_of_primitives_; ++i) {
    if (primitives_[i] == primitive) {
      return i;
    }
  }
  return NO_JOINT;
}

bool JointDriver::Check(OStatus status, int joint, const char* otherwise) const {
  if (status != oSUCCESS) {
    OSYSLOG1(
        (osyslogERROR, "RCServer: %s %s (status %u)", joints_->Name(joint), otherwise, static_cast<unsigned>(status)));
  }
  return status == oSUCCESS;
}

void JointDriver::Report(int joint, JointWatch::Verdict verdict) const {
  if (verdict != JointWatch::FOLLOWS) {
    OSYSLOG1((osyslogERROR, "RCServer: %s %s; it is held where it is", joints_->Name(joint),
              verdict == JointWatch::JAMMED ? "is jammed" : "does not follow"));
  }
}
