#include "rcserver/body/JointDriver.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <string.h>

using namespace robot_model;

JointDriver::JointDriver(const RobotModel& robot)
    : robot_(OpenPrimitives(robot) ? robot : EMPTY_ROBOT),
      joints_(robot_),
      state_(OFF),
      vectors_until_gains_(0),
      now_(0) {}

bool JointDriver::Switch(bool on) {
  if (!on) {
    joints_.MotorsGoOff();
  }
  if (on == AreOn()) {
    return true;
  }
  if (on) {
    return SwitchOn();
  }
  state_ = OFF;
  for (int i = 0; i < joints_.NumberOfJoints(); ++i) {
    Check(OPENR::DisableJointGain(primitives_.Id(i)), i, "still holds its position");
  }
  return true;
}

bool JointDriver::HasCommand() const {
  if (state_ == OFF) {
    return false;
  }
  if (state_ == GOING_ON || joints_.AreMoving()) {
    return true;
  }
  for (int i = 0; i < joints_.NumberOfJoints(); ++i) {
    if (joints_.Planner().Position(i) != commanded_[i]) {
      return true;
    }
  }
  return false;
}

void JointDriver::Fill(RCRegion* vector) {
  OCommandData* data[MAX_JOINTS];
  for (int i = 0; i < joints_.NumberOfJoints(); ++i) {
    data[i] = CommandVectors::Add(vector, odataJOINT_COMMAND2, primitives_.Id(i), CommandVectors::FRAMES);
  }
  for (int frame = 0; frame < CommandVectors::FRAMES; ++frame) {
    if (state_ == ON) {
      joints_.NextFrame();
    }
    for (int i = 0; i < joints_.NumberOfJoints(); ++i) {
      commanded_[i] = joints_.Planner().Position(i);
      OJointCommandValue2 value = {commanded_[i], 0};
      memcpy(&data[i]->value[frame], &value, sizeof(value));
    }
  }
}

void JointDriver::Sent(int vectors_ahead) {
  if (state_ == GOING_ON && vectors_until_gains_ == 0) {
    vectors_until_gains_ = vectors_ahead + 1;
  }
}

void JointDriver::OutputIsComplete() {
  if (state_ == GOING_ON && vectors_until_gains_ > 0 && --vectors_until_gains_ == 0) {
    EnableGains();
  }
}

bool JointDriver::ReadSensors(OSensorFrameVectorData* sensors, longword* frame) {
  SensorReports reports(sensors, primitives_);
  bool is_any = false;
  while (reports.Next()) {
    is_any = true;
    now_ = reports.Frame();
    *frame = now_;
    OJointValue report;
    reports.Read(&report);
    const JointReading reading = {report.value, report.refValue, report.pwmDuty};
    Report(reports.Row(), joints_.Measured(reports.Row(), reading, now_, state_ == ON));
  }
  return is_any;
}

// Opens all joints or none.
bool JointDriver::OpenPrimitives(const RobotModel& robot) {
  for (int i = 0; i < robot.number_of_joints; ++i) {
    const Joint& joint = robot.joints[i];
    if (!primitives_.Open(i, joint.name, joint.locator)) {
      OSYSLOG1((osyslogERROR, "RCServer: without %s, no joint is moved", joint.name));
      primitives_.Close();
      return false;
    }
  }
  return true;
}

bool JointDriver::SwitchOn() {
  if (joints_.NumberOfJoints() == 0) {
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
  vectors_until_gains_ = 0;
  return true;
}

bool JointDriver::HoldPresentPositions() {
  for (int i = 0; i < joints_.NumberOfJoints(); ++i) {
    OJointValue value;
    if (!Check(OPENR::GetJointValue(primitives_.Id(i), &value), i,
               "does not report its position, so the motors stay off")) {
      return false;
    }
    joints_.Hold(i, value.value, now_);
  }
  return true;
}

void JointDriver::EnableGains() {
  for (int i = 0; i < joints_.NumberOfJoints(); ++i) {
    if (!EnableGain(i)) {
      joints_.Failed(i, JointWatch::LIMP);
    }
  }
  state_ = ON;
}

bool JointDriver::EnableGain(int joint) const {
  const PidGains& gains = robot_.joints[joint].gains;
  const OPrimitiveID id = primitives_.Id(joint);
  return Check(OPENR::EnableJointGain(id), joint, "is limp: its gain cannot be enabled") &&
         Check(OPENR::SetJointGain(id, gains.proportional, gains.integral, gains.derivative, gains.proportional_shift,
                                   gains.integral_shift, gains.derivative_shift),
               joint, "is limp: its gain cannot be set");
}

bool JointDriver::Check(OStatus status, int joint, const char* otherwise) const {
  if (status != oSUCCESS) {
    OSYSLOG1(
        (osyslogERROR, "RCServer: %s %s (status %u)", joints_.Name(joint), otherwise, static_cast<unsigned>(status)));
  }
  return status == oSUCCESS;
}

void JointDriver::Report(int joint, JointWatch::Verdict verdict) const {
  if (verdict != JointWatch::FOLLOWS) {
    OSYSLOG1((osyslogERROR, "RCServer: %s %s; it is held where it is", joints_.Name(joint),
              verdict == JointWatch::JAMMED ? "is jammed" : "does not follow"));
  }
}
