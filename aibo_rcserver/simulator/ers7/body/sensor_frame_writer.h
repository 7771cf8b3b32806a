/// @file sensor_frame_writer.h
/// Writes readings in the ERS-7's layout: an OSensorFrameVectorData with an entry for each joint or sensor, then the
/// frames. A joint's frames are OJointValues instead of OSensorValues.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_BODY_SENSOR_FRAME_WRITER_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_BODY_SENSOR_FRAME_WRITER_H

#include <OPENR/ODataFormats.h>
#include <OPENR/RCRegion.h>

#include <cstddef>
#include <vector>

#include "simulator/ers7/body/joint.h"

namespace simulated_ers7 {

struct SensorFrameEntry {
  OPrimitiveID primitive;
  ODataType type;
};

/// The size of a region with this many entries, in bytes.
std::size_t sensorFramesSize(std::size_t entries);

/// Writes the constant part: the header, and the infos without the frame number.
/// @param region a region of sensorFramesSize() bytes
void prepareSensorFrames(RCRegion* region, const std::vector<SensorFrameEntry>& entries);

/// Writes the readings of an entry into a prepared region.
/// @param frame the OPEN-R frame of the last reading; the info gets the frame of the first
/// @param readings Joint::kReadings OSensorValues or OJointValues
void writeSensorFrames(RCRegion* region, std::size_t entry, longword frame, const void* readings);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_SENSOR_FRAME_WRITER_H
