/// @file image_sensor.h
/// Turns the light in front of the camera into its picture: lens, sensor and electronics.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_IMAGE_SENSOR_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_IMAGE_SENSOR_H

#include <cstdint>
#include <vector>

#include "simulator/ers7/camera/camera.h"
#include "simulator/ers7/camera/renderer.h"
#include "simulator/ers7/camera/ycrcb_image.h"

namespace simulated_ers7 {

/// Blurs the picture slightly, as small lenses do, and darkens the corners, red more than blue, as on real robots. The
/// class is not thread-safe.
class Lens {
 public:
  Lens();

  /// @return the light on the sensor, valid until the next call
  const LightImage& project(const LightImage& light);

 private:
  LightImage transmission_;  ///< share of the light that reaches each pixel
  LightImage blurred_across_;
  LightImage projected_;
};

/// Turns light into pictures. The same seed, image number, settings and light always give the same picture.
class ImageSensor {
 public:
  explicit ImageSensor(std::uint64_t seed);

  /// @param detail the light's fine detail
  /// @param image_number selects the noise
  void expose(const LightImage& light, const DetailImage& detail, const CameraSettings& settings, longword image_number,
              YCrCbImage* picture) const;

 private:
  void exposeDetail(const LightImage& light, const DetailImage& detail, const CameraSettings& settings,
                    longword image_number, YCrCbImage* picture) const;

  std::uint64_t seed_;
  std::vector<float> tone_curve_;     ///< from light to 0..255
  std::vector<float> random_values_;  ///< normally distributed, with deviation 1
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_IMAGE_SENSOR_H
