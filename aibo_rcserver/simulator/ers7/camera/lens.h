/// @file lens.h
/// What a real lens does to the light that an ideal one would let through.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_LENS_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_LENS_H

#include "simulator/ers7/camera/renderer.h"

namespace simulated_ers7 {

/// Blurs a little, as small lenses do, and lets less light through towards the corners, of red less than of blue, as
/// was seen with real robots. Not thread-safe.
class Lens {
 public:
  Lens();

  /// @return the light on the sensor, valid until the next call
  const LightImage& project(const LightImage& light);

 private:
  LightImage transmission_;  ///< what reaches each pixel, 1 = all
  LightImage blurred_across_;
  LightImage projected_;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_LENS_H
