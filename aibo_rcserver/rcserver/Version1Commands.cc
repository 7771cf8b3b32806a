#include "rcserver/Version1Commands.h"

#include "protocol/angles.h"

using protocol::centidegreesFromMicroradians;
using protocol::microradiansFromCentidegrees;
using robot_model::MAX_JOINTS;
using robot_model::NO_JOINT;

namespace {

const unsigned char ALL = 0;  // identifier

}  // namespace

Version1Commands::Version1Commands(JointControl& joints, const Motors& motors, ImageObserver& camera, Outbox& outbox)
    : joints_(joints), motors_(motors), camera_(camera), outbox_(outbox) {
  Begin();
}

void Version1Commands::Begin() {
  for (int i = 0; i < MAX_JOINTS; ++i) {
    is_in_block_[i] = true;
  }
}

void Version1Commands::Handle(const protocol::Request& request) {
  if (!request.valid || !Execute(request)) {
    Refuse();
  }
}

void Version1Commands::Refuse() {
  Reply(protocol::REPLY_ERROR, 0, protocol::ERROR_REFUSED);
}

// False: to be refused.
bool Version1Commands::Execute(const protocol::Request& request) {
  const unsigned char identifier = request.basic.identifier;
  const PictureOrder order = {protocol::limitJpegQuality(identifier), 0, 0};
  const bool is_write = request.payload_size > 0;
  const short value = is_write ? protocol::decodeValue(request.payload) : static_cast<short>(0);
  const int joint = joints_.Find(identifier);

  switch (request.basic.command) {
    case protocol::REQUEST_PICTURE:
      return camera_.RequestPicture(order);
    case protocol::REQUEST_STREAM_TOGGLE:
      camera_.ToggleStream(order);
      return true;
    case protocol::REQUEST_JOINT:
      if (identifier == ALL) {
        return is_write && SetAllPositions(value);
      }
      return joint != NO_JOINT && (is_write ? SetPosition(joint, value) : ReadPosition(joint));
    case protocol::REQUEST_SENSOR:
      if (identifier == ALL) {
        return !is_write && ReadSensorBlock();
      }
      return joint != NO_JOINT && (is_write ? IncludeSensor(joint, value) : ReadSensor(joint));
    case protocol::REQUEST_MAX_VELOCITY:
      return joint != NO_JOINT && (is_write ? SetSpeedLimit(joint, value) : ReadSpeedLimit(joint));
    case protocol::REQUEST_MAX_ACCELERATION:
      return joint != NO_JOINT && (is_write ? SetAccelerationLimit(joint, value) : ReadAccelerationLimit(joint));
    default:
      return false;
  }
}

bool Version1Commands::ReadPosition(int joint) {
  return !HasFault(joint) &&
         Reply('j', joints_.Identifier(joint), centidegreesFromMicroradians(joints_.Position(joint)));
}

bool Version1Commands::SetPosition(int joint, short angle) {
  if (HasFault(joint) || !motors_.AreOn()) {
    return false;
  }
  const int accepted = joints_.Planner().SetTarget(joint, microradiansFromCentidegrees(angle));
  return Reply('j', joints_.Identifier(joint), centidegreesFromMicroradians(accepted));
}

bool Version1Commands::SetAllPositions(short angle) {
  if (HasAnyFault() || !motors_.AreOn()) {
    return false;
  }
  MotionPlanner::JointTarget targets[MAX_JOINTS];
  for (int i = 0; i < joints_.NumberOfJoints(); ++i) {
    targets[i].joint = i;
    targets[i].position = microradiansFromCentidegrees(angle);
  }
  joints_.Planner().SetTargets(targets, joints_.NumberOfJoints(), 0);
  return Reply('j', ALL, angle);
}

// Version 1 cannot push anything, so the next question about the joint is what is answered by an error, once.
bool Version1Commands::HasFault(int joint) {
  return joints_.TakeFault(joint) != JointWatch::FOLLOWS;
}

bool Version1Commands::HasAnyFault() {
  bool is_any = false;
  for (int i = 0; i < joints_.NumberOfJoints(); ++i) {
    is_any = HasFault(i) || is_any;
  }
  return is_any;
}

bool Version1Commands::ReadSensor(int joint) {
  return Reply('s', joints_.Identifier(joint), centidegreesFromMicroradians(joints_.Position(joint)));
}

bool Version1Commands::IncludeSensor(int joint, short included) {
  if (included != 0 && included != 1) {
    return false;
  }
  is_in_block_[joint] = included == 1;
  return Reply('s', joints_.Identifier(joint), included);
}

// Values without a header, in the order of the robot's table.
bool Version1Commands::ReadSensorBlock() {
  unsigned char block[MAX_JOINTS * protocol::VALUE_SIZE];
  size_t size = 0;
  for (int i = 0; i < joints_.NumberOfJoints(); ++i) {
    if (is_in_block_[i]) {
      protocol::encodeValue(centidegreesFromMicroradians(joints_.Position(i)), block + size);
      size += protocol::VALUE_SIZE;
    }
  }
  outbox_.Add(block, size);
  return Reply('s', ALL, 0);
}

bool Version1Commands::ReadSpeedLimit(int joint) {
  return Reply('v', joints_.Identifier(joint), centidegreesFromMicroradians(joints_.Planner().SpeedLimit(joint)));
}

bool Version1Commands::SetSpeedLimit(int joint, short limit) {
  joints_.Planner().SetSpeedLimit(joint, microradiansFromCentidegrees(limit));
  return ReadSpeedLimit(joint);
}

bool Version1Commands::ReadAccelerationLimit(int joint) {
  return Reply('a', joints_.Identifier(joint),
               centidegreesFromMicroradians(joints_.Planner().AccelerationLimit(joint)));
}

bool Version1Commands::SetAccelerationLimit(int joint, short limit) {
  joints_.Planner().SetAccelerationLimit(joint, microradiansFromCentidegrees(limit));
  return ReadAccelerationLimit(joint);
}

bool Version1Commands::Reply(char letter, int identifier, short value) {
  const protocol::ValueReply reply = {letter, static_cast<unsigned char>(identifier), value};
  unsigned char message[protocol::VALUE_REPLY_SIZE];
  protocol::encodeValueReply(reply, message);
  outbox_.Add(message, sizeof(message));
  return true;
}
