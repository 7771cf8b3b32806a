#include "rcserver/version1/Version1Joints.h"

#include "protocol/units.h"

using protocol::centidegreesFromMicroradians;
using protocol::microradiansFromCentidegrees;
using robot_model::MAX_JOINTS;
using robot_model::NO_JOINT;

bool Version1Joints::Execute(const protocol::Request& request) {
  const bool is_write = request.payload_size > 0;
  const short value = is_write ? protocol::decodeValue(request.payload) : static_cast<short>(0);
  if (request.basic.identifier == protocol::ALL_IDENTIFIERS) {
    return request.basic.command == protocol::REQUEST_JOINT && is_write && SetAllPositions(value);
  }
  const int joint = joints_.Find(request.basic.identifier);
  if (joint == NO_JOINT) {
    return false;
  }
  switch (request.basic.command) {
    case protocol::REQUEST_JOINT:
      return is_write ? SetPosition(joint, value) : ReadPosition(joint);
    case protocol::REQUEST_MAX_VELOCITY:
      is_write ? SetSpeedLimit(joint, value) : ReadSpeedLimit(joint);
      return true;
    case protocol::REQUEST_MAX_ACCELERATION:
      is_write ? SetAccelerationLimit(joint, value) : ReadAccelerationLimit(joint);
      return true;
    default:
      return false;
  }
}

bool Version1Joints::ReadPosition(int joint) {
  if (HasFault(joint)) {
    return false;
  }
  replies_.Value('j', joints_.Identifier(joint), centidegreesFromMicroradians(joints_.Position(joint)));
  return true;
}

bool Version1Joints::SetPosition(int joint, short angle) {
  if (HasFault(joint) || !motors_.AreOn()) {
    return false;
  }
  MotionPlanner::JointTarget target = {joint, microradiansFromCentidegrees(angle)};
  joints_.SetTargets(&target, 1, 0);
  replies_.Value('j', joints_.Identifier(joint), centidegreesFromMicroradians(target.position));
  return true;
}

bool Version1Joints::SetAllPositions(short angle) {
  if (HasAnyFault() || !motors_.AreOn()) {
    return false;
  }
  MotionPlanner::JointTarget targets[MAX_JOINTS];
  for (int i = 0; i < joints_.NumberOfJoints(); ++i) {
    targets[i].joint = i;
    targets[i].position = microradiansFromCentidegrees(angle);
  }
  joints_.SetTargets(targets, joints_.NumberOfJoints(), 0);
  replies_.Value('j', protocol::ALL_IDENTIFIERS, angle);
  return true;
}

// Version 1 cannot push anything, so the next question about the joint is what is answered by an error, once.
bool Version1Joints::HasFault(int joint) {
  return joints_.TakeFault(joint) != JointWatch::FOLLOWS;
}

bool Version1Joints::HasAnyFault() {
  bool is_any = false;
  for (int i = 0; i < joints_.NumberOfJoints(); ++i) {
    is_any = HasFault(i) || is_any;
  }
  return is_any;
}

void Version1Joints::ReadSpeedLimit(int joint) {
  replies_.Value('v', joints_.Identifier(joint), centidegreesFromMicroradians(joints_.Planner().SpeedLimit(joint)));
}

void Version1Joints::SetSpeedLimit(int joint, short limit) {
  joints_.Planner().SetSpeedLimit(joint, microradiansFromCentidegrees(limit));
  ReadSpeedLimit(joint);
}

void Version1Joints::ReadAccelerationLimit(int joint) {
  replies_.Value('a', joints_.Identifier(joint),
                 centidegreesFromMicroradians(joints_.Planner().AccelerationLimit(joint)));
}

void Version1Joints::SetAccelerationLimit(int joint, short limit) {
  joints_.Planner().SetAccelerationLimit(joint, microradiansFromCentidegrees(limit));
  ReadAccelerationLimit(joint);
}
