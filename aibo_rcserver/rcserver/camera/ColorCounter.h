#ifndef AIBO_RCSERVER_RCSERVER_CAMERA_COLOR_COUNTER_H
#define AIBO_RCSERVER_RCSERVER_CAMERA_COLOR_COUNTER_H

#include <stddef.h>

#include "protocol/color_requests.h"

/// The colour detection plane of one camera image. Each pixel is a byte with a bit for each channel that has detected
/// it. The lowest bit belongs to channel 0 (ocdtCHANNEL0 in OPENR/ODataFormats.h).
///
/// The camera overwrites the beginning of the last row (OPENR/OFbkImage.h), so that row is ignored, as in Sony's sample
/// BallTrackingHead7.
struct ColorPlane {
  const unsigned char* pixels;  ///< NULL: the camera's image has no such plane
  size_t width;                 ///< pixels
  size_t height;                ///< pixels, including the last row
  size_t stride;                ///< bytes from one row to the next

  size_t Rows() const { return height - 1; }
};

/// Counts the pixels of each channel, and finds their centroid and bounding box. It scans the plane once, run by run,
/// so its time hardly depends on the number of channels.
/// @param channels bits of the channels that are wanted
/// @param[out] regions gets the count and the regions, one for each of these channels
void countColors(const ColorPlane& plane, unsigned char channels, protocol::version2::ColorRegions* regions);

/// Most bytes of a packed plane that is sent, row by row.
const size_t MAX_PACKED_PLANE_SIZE =
    protocol::version2::MAX_COLOR_PLANE_HEIGHT * (protocol::version2::MAX_COLOR_PLANE_WIDTH + 1);

/// True if a plane is small enough to be sent: not larger than an ERS-7's.
bool canPackPlane(const ColorPlane& plane);

/// Packs the plane row by row (protocol::version2::packColorPlane()). The last row becomes empty.
/// @param out room for MAX_PACKED_PLANE_SIZE bytes
/// @return the number of bytes
size_t packPlane(const ColorPlane& plane, unsigned char* out);

#endif  // AIBO_RCSERVER_RCSERVER_CAMERA_COLOR_COUNTER_H
