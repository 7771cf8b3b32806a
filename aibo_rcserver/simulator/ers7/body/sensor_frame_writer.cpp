#include "simulator/ers7/body/sensor_frame_writer.h"

#include <cstring>

namespace simulated_ers7 {
namespace {

static_assert(sizeof(OJointValue) == sizeof(OSensorValue), "a joint's values take the place of a sensor's");

OSensorFrameVectorData* framesIn(RCRegion* region) {
  void* base = region->Base();
  return static_cast<OSensorFrameVectorData*>(base);
}

/// The offset of the data from the beginning of the header.
std::size_t dataOffset(std::size_t entries) {
  return offsetof(OSensorFrameVectorData, info) + entries * sizeof(OSensorFrameInfo);
}

}  // namespace

std::size_t sensorFramesSize(std::size_t entries) {
  return dataOffset(entries) + entries * sizeof(OSensorFrameData);
}

void prepareSensorFrames(RCRegion* region, const std::vector<SensorFrameEntry>& entries) {
  ODataVectorInfo& header = framesIn(region)->vectorInfo;
  header = ODataVectorInfo();
  header.type = odataSENSOR_FRAME_VECTOR;
  header.memRegionID = region->MemID();
  header.offset = static_cast<longword>(region->Offset());
  header.totalSize = static_cast<longword>(sensorFramesSize(entries.size()));
  header.infoOffset = offsetof(OSensorFrameVectorData, info);
  header.infoSize = sizeof(OSensorFrameInfo);
  header.maxNumData = static_cast<longword>(entries.size());
  header.numData = header.maxNumData;
  std::size_t offset = dataOffset(entries.size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    OSensorFrameInfo* info = framesIn(region)->GetInfo(static_cast<int>(i));
    *info = OSensorFrameInfo();
    info->type = entries[i].type;
    info->primitiveID = entries[i].primitive;
    info->numFrames = Joint::kReadings;
    info->frameSize = sizeof(OSensorValue);
    info->dataOffset = static_cast<longword>(offset);
    info->dataSize = sizeof(OSensorFrameData);
    offset += sizeof(OSensorFrameData);
  }
}

void writeSensorFrames(RCRegion* region, std::size_t entry, longword frame, const void* readings) {
  const int index = static_cast<int>(entry);
  framesIn(region)->GetInfo(index)->frameNumber = frame - (Joint::kReadings - 1);
  std::memcpy(framesIn(region)->GetData(index)->frame, readings, Joint::kReadings * sizeof(OSensorValue));
}

}  // namespace simulated_ers7
