/// @file sensor_frame_writer.h
/// Lays out what the joints measured as the ERS-7 delivers it: an OSensorFrameVectorData with its frames behind it.
///
/// One entry a joint. Its frames are OJointValues laid over OSensorValues.
#ifndef SIMULATED_ERS7_SENSOR_FRAME_WRITER_H
#define SIMULATED_ERS7_SENSOR_FRAME_WRITER_H

#include <OPENR/ODataFormats.h>
#include <OPENR/RCRegion.h>

#include <cstddef>
#include <vector>

#include "simulated_ers7/joint.h"

namespace simulated_ers7 {

/// Bytes of a region with so many entries.
std::size_t sensorFramesSize(std::size_t entries);

/// Writes what is the same in all vectors: the header and the infos, without the number of the frame.
/// @param region sensorFramesSize() bytes
/// @param primitives of the entries, in their order
void prepareSensorFrames(RCRegion* region, const std::vector<OPrimitiveID>& primitives);

/// Writes the joints' readings into a prepared region.
/// @param frame OPEN-R frame of the last readings. The infos name the first.
/// @param joints in the order of the primitives
void writeSensorFrames(RCRegion* region, longword frame, const std::vector<Joint>& joints);

}  // namespace simulated_ers7

#endif  // SIMULATED_ERS7_SENSOR_FRAME_WRITER_H
