/// @file image_sensor.h
/// What sensor and electronics make of the light: colours of the right brightness and tint, with noise.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_IMAGE_SENSOR_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_IMAGE_SENSOR_H

#include <cstdint>
#include <vector>

#include "simulator/ers7/camera/camera_settings.h"
#include "simulator/ers7/camera/renderer.h"
#include "simulator/ers7/camera/ycrcb_image.h"

namespace simulated_ers7 {

/// The same seed, image number, settings and light always give the same picture.
class ImageSensor {
 public:
  explicit ImageSensor(std::uint64_t seed);

  /// @param image_number makes the noise of each picture another one
  void expose(const LightImage& light, const CameraSettings& settings, longword image_number,
              YCrCbImage* picture) const;

 private:
  std::uint64_t seed_;
  std::vector<float> tone_curve_;     ///< from light to 0..255
  std::vector<float> random_values_;  ///< normally distributed, deviation 1
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_IMAGE_SENSOR_H
