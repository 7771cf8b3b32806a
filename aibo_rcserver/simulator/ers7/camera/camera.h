/// @file camera.h
/// The ERS-7's camera: when it has an image, and the image in the layout of OPEN-R.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_CAMERA_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_CAMERA_H

#include <OPENR/OPENR.h>
#include <OPENR/OPrimitiveControl.h>
#include <OPENR/RCRegion.h>

#include "simulator/ers7/camera/camera_settings.h"
#include "simulator/ers7/camera/picture_source.h"
#include "simulator/ers7/region_pool.h"

namespace simulated_ers7 {

/// Frames are OPEN-R frames of 8 ms since the robot was switched on. Not thread-safe.
class Camera {
 public:
  /// @param source gives the pictures; must outlive the camera
  /// @param id the camera's primitive, which its images name
  Camera(PictureSource& source, OPrimitiveID id);

  /// True once for each image (camera_timing.h), in its frame or in the next one that is asked for. The camera goes on
  /// counting images that nobody asks for.
  /// @param frame not lower than in the call before
  bool imageDue(longword frame);

  /// Takes an image. It is drawn into a region that nobody but the camera refers to (region_pool.h).
  RCRegion* capture(longword frame);

  /// @see controlCamera()
  OStatus control(OPrimitiveRequest request, const void* param, size_t param_size);

  const CameraSettings& settings() const { return settings_; }

  /// As after switching on.
  void resetSettings() { settings_ = CameraSettings(); }

 private:
  PictureSource& source_;
  CameraSettings settings_;
  longword images_seen_ = 0;
  RegionPool regions_;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_CAMERA_H
