/// @file sensor_frame_writer.h
/// Lays out what joints and sensors measured as the ERS-7 delivers it: an OSensorFrameVectorData with its frames behind
/// it, one entry a joint or sensor. A joint's frames are OJointValues laid over OSensorValues.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_BODY_SENSOR_FRAME_WRITER_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_BODY_SENSOR_FRAME_WRITER_H

#include <OPENR/ODataFormats.h>
#include <OPENR/RCRegion.h>

#include <cstddef>
#include <vector>

#include "simulator/ers7/body/joint.h"

namespace simulated_ers7 {

/// What an entry is of.
struct SensorFrameEntry {
  OPrimitiveID primitive;
  ODataType type;
};

/// Bytes of a region with so many entries.
std::size_t sensorFramesSize(std::size_t entries);

/// Writes what is the same in all vectors: the header and the infos, without the number of the frame.
/// @param region sensorFramesSize() bytes
void prepareSensorFrames(RCRegion* region, const std::vector<SensorFrameEntry>& entries);

/// Writes the readings of one entry into a prepared region.
/// @param frame OPEN-R frame of the last reading. The info names the first.
/// @param readings Joint::kReadings OSensorValues or OJointValues
void writeSensorFrames(RCRegion* region, std::size_t entry, longword frame, const void* readings);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_SENSOR_FRAME_WRITER_H
