/// @file sensor_frame_writer.h
/// Writes the readings of joints and sensors in the ERS-7's layout: an OSensorFrameVectorData followed by its frames,
/// one entry per joint or sensor. A joint's frames are OJointValues in place of OSensorValues.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_BODY_SENSOR_FRAME_WRITER_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_BODY_SENSOR_FRAME_WRITER_H

#include <OPENR/ODataFormats.h>
#include <OPENR/RCRegion.h>

#include <cstddef>
#include <vector>

#include "simulator/ers7/body/joint.h"

namespace simulated_ers7 {

/// The primitive of an entry.
struct SensorFrameEntry {
  OPrimitiveID primitive;
  ODataType type;
};

/// Size in bytes of a region with this many entries.
std::size_t sensorFramesSize(std::size_t entries);

/// Writes the constant part of a vector: the header, and the infos without the frame number.
/// @param region sensorFramesSize() bytes
void prepareSensorFrames(RCRegion* region, const std::vector<SensorFrameEntry>& entries);

/// Writes the readings of one entry into a prepared region.
/// @param frame OPEN-R frame of the last reading; the info contains that of the first
/// @param readings Joint::kReadings OSensorValues or OJointValues
void writeSensorFrames(RCRegion* region, std::size_t entry, longword frame, const void* readings);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_SENSOR_FRAME_WRITER_H
