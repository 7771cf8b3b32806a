#include "rcserver/Version1Sensors.h"

#include "protocol/angles.h"

using protocol::centidegreesFromMicroradians;
using robot_model::MAX_JOINTS;
using robot_model::NO_JOINT;

Version1Sensors::Version1Sensors(const JointControl& joints, Version1Replies& replies)
    : joints_(joints), replies_(replies) {
  Begin();
}

void Version1Sensors::Begin() {
  for (int i = 0; i < MAX_JOINTS; ++i) {
    is_in_block_[i] = true;
  }
}

bool Version1Sensors::Execute(const protocol::Request& request) {
  const bool is_write = request.payload_size > 0;
  if (request.basic.identifier == VERSION1_ALL) {
    if (!is_write) {
      ReadBlock();
    }
    return !is_write;
  }
  const int joint = joints_.Find(request.basic.identifier);
  if (joint == NO_JOINT) {
    return false;
  }
  if (is_write) {
    return Include(joint, protocol::decodeValue(request.payload));
  }
  Read(joint);
  return true;
}

void Version1Sensors::Read(int joint) {
  replies_.Value('s', joints_.Identifier(joint), centidegreesFromMicroradians(joints_.Position(joint)));
}

bool Version1Sensors::Include(int joint, short included) {
  if (included != 0 && included != 1) {
    return false;
  }
  is_in_block_[joint] = included == 1;
  replies_.Value('s', joints_.Identifier(joint), included);
  return true;
}

// Values without a header, in the order of the robot's table.
void Version1Sensors::ReadBlock() {
  unsigned char block[MAX_JOINTS * protocol::VALUE_SIZE];
  size_t size = 0;
  for (int i = 0; i < joints_.NumberOfJoints(); ++i) {
    if (is_in_block_[i]) {
      protocol::encodeValue(centidegreesFromMicroradians(joints_.Position(i)), block + size);
      size += protocol::VALUE_SIZE;
    }
  }
  replies_.Block(block, size);
  replies_.Value('s', VERSION1_ALL, 0);
}
