#include "rcserver/version2/Version2Joints.h"

#include <stdio.h>

using namespace protocol::version2;
using robot_model::NO_JOINT;

void Version2Joints::Move(const Request& request, const unsigned char* payload) {
  JointTargets wanted;
  if (const char* problem = decodeJointTargets(payload, request.payload_size, &wanted)) {
    replies_.RefuseBadRequest(request, problem);
    return;
  }
  if (!motors_.AreOn()) {
    replies_.Refuse(request, CODE_REFUSED, "the motors are off; switch them on first");
    return;
  }
  MotionPlanner::JointTarget targets[MAX_JOINTS];
  for (int i = 0; i < wanted.count; ++i) {
    targets[i].joint = joints_.Find(wanted.joints[i].id);
    targets[i].position = wanted.joints[i].value;
    if (targets[i].joint == NO_JOINT) {
      RefuseUnknownJoint(request, wanted.joints[i].id);
      return;
    }
  }
  joints_.SetTargets(targets, wanted.count, wanted.duration_ms);
  for (int i = 0; i < wanted.count; ++i) {
    wanted.joints[i].value = targets[i].position;
  }
  replies_.Reply(request, encodeJointTargets(wanted, replies_.Payload()));
}

void Version2Joints::LimitSpeeds(const Request& request, const unsigned char* payload) {
  SpeedLimits limits;
  if (const char* problem = decodeSpeedLimits(payload, request.payload_size, &limits)) {
    replies_.RefuseBadRequest(request, problem);
    return;
  }
  for (int i = 0; i < limits.count; ++i) {
    if (joints_.Find(limits.joints[i].id) == NO_JOINT) {
      RefuseUnknownJoint(request, limits.joints[i].id);
      return;
    }
  }
  MotionPlanner& planner = joints_.Planner();
  for (int i = 0; i < limits.count; ++i) {
    limits.joints[i].value = planner.SetSpeedLimit(joints_.Find(limits.joints[i].id), limits.joints[i].value);
  }
  if (limits.count == 0) {
    limits.count = static_cast<unsigned char>(joints_.NumberOfJoints());
    for (int i = 0; i < joints_.NumberOfJoints(); ++i) {
      limits.joints[i].id = joints_.Identifier(i);
      limits.joints[i].value = planner.SpeedLimit(i);
    }
  }
  replies_.Reply(request, encodeSpeedLimits(limits, replies_.Payload()));
}

void Version2Joints::SwitchMotors(const Request& request, const unsigned char* payload) {
  if (request.payload_size > 0) {
    bool on = false;
    if (const char* problem = decodeMotorState(payload, request.payload_size, &on)) {
      replies_.RefuseBadRequest(request, problem);
      return;
    }
    if (!motors_.Switch(on)) {
      replies_.Refuse(request, CODE_REFUSED, "the robot does not switch its motors on; its console says why");
      return;
    }
  }
  replies_.Reply(request, encodeMotorState(motors_.AreOn(), replies_.Payload()));
}

const char* Version2Joints::WordsFor(JointWatch::Verdict fault) {
  switch (fault) {
    case JointWatch::JAMMED:
      return "is jammed: its motor pushes and it does not move. It is held where it is until it is commanded again";
    case JointWatch::LIMP:
      return "is limp: its motor got no gain. Switch the motors off and on again; the robot's console has the reason";
    default:
      return "does not follow what it is told. It is held where it is until it is commanded again";
  }
}

// A fault that finds no room is pushed the next time.
void Version2Joints::PushFaults() {
  for (int i = 0; i < joints_.NumberOfJoints() && replies_.HasRoom(); ++i) {
    const JointWatch::Verdict fault = joints_.TakeFault(i);
    if (fault != JointWatch::FOLLOWS) {
      char text[MAX_ERROR_TEXT_SIZE];
      sprintf(text, "%s %s", joints_.Name(i), WordsFor(fault));
      replies_.PushError(CODE_JOINT_FAULT, text);
    }
  }
}

void Version2Joints::RefuseUnknownJoint(const Request& request, unsigned char identifier) {
  char text[MAX_ERROR_TEXT_SIZE];
  sprintf(text, "there is no joint %d on this robot, so nothing of the request was done", identifier);
  replies_.Refuse(request, CODE_REFUSED, text);
}
