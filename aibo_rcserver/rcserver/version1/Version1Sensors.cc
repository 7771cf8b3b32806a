#include "rcserver/version1/Version1Sensors.h"

#include <algorithm>

#include "protocol/units.h"

const int Version1Sensors::MAX_SOURCES;

Version1Sensors::Version1Sensors(const JointControl& joints, const Sensors& sensors, Version1Replies& replies)
    : joints_(joints), sensors_(sensors), replies_(replies), number_of_sources_(0) {
  for (int i = 0; i < joints.NumberOfJoints(); ++i) {
    Add(joints.Identifier(i), true, i);
  }
  for (int i = 0; i < sensors.NumberOfSensors(); ++i) {
    Add(sensors.Sensor(i).identifier, false, i);
  }
  std::sort(sources_, sources_ + number_of_sources_);
}

void Version1Sensors::Begin() {
  for (int i = 0; i < number_of_sources_; ++i) {
    sources_[i].is_in_block = true;
  }
}

bool Version1Sensors::Execute(const protocol::Request& request) {
  const bool is_write = request.payload_size > 0;
  if (request.basic.identifier == protocol::ALL_IDENTIFIERS) {
    if (!is_write) {
      ReadBlock();
    }
    return !is_write;
  }
  Source* source = Find(request.basic.identifier);
  if (source == NULL) {
    return false;
  }
  if (!is_write) {
    replies_.Value('s', source->identifier, Value(*source));
    return true;
  }
  const short included = protocol::decodeValue(request.payload);
  if (included != 0 && included != 1) {
    return false;
  }
  source->is_in_block = included == 1;
  replies_.Value('s', source->identifier, included);
  return true;
}

void Version1Sensors::Add(unsigned char identifier, bool is_joint, int index) {
  const Source source = {identifier, is_joint, index, true};
  sources_[number_of_sources_] = source;
  ++number_of_sources_;
}

Version1Sensors::Source* Version1Sensors::Find(int identifier) {
  for (int i = 0; i < number_of_sources_; ++i) {
    if (sources_[i].identifier == identifier) {
      return &sources_[i];
    }
  }
  return NULL;
}

short Version1Sensors::Value(const Source& source) const {
  if (source.is_joint) {
    return protocol::centidegreesFromMicroradians(joints_.Position(source.index));
  }
  return protocol::version1SensorValue(sensors_.Sensor(source.index).kind, sensors_.Value(source.index));
}

// Values without a header. What has measured nothing reads as 0, so that each value keeps its place.
void Version1Sensors::ReadBlock() {
  unsigned char block[MAX_SOURCES * protocol::VALUE_SIZE];
  size_t size = 0;
  for (int i = 0; i < number_of_sources_; ++i) {
    if (sources_[i].is_in_block) {
      protocol::encodeValue(Value(sources_[i]), block + size);
      size += protocol::VALUE_SIZE;
    }
  }
  replies_.Block(block, size);
  replies_.Value('s', protocol::ALL_IDENTIFIERS, 0);
}
