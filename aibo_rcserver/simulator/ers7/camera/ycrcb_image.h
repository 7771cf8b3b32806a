/// @file ycrcb_image.h
/// A picture with the size of the H layer, in the camera's colours, and its fine detail.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_YCRCB_IMAGE_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_YCRCB_IMAGE_H

#include <cstdint>
#include <vector>

#include "simulator/ers7/camera/camera_optics.h"

namespace simulated_ers7 {

/// Three planes of kPictureWidth x kPictureHeight bytes, row by row from the upper left, in the full-range colours of
/// JPEG files (ITU-R BT.601): Y 0..255; Cr and Cb 128 for grey.
struct YCrCbImage {
  using Plane = std::vector<std::uint8_t>;

  Plane y = Plane(kSize);
  Plane cr = Plane(kSize);
  Plane cb = Plane(kSize);

  /// What the luminance of twice the width and height has and Y lacks: of each four pixels, the lower less the upper
  /// ones (LH), the right less the left ones (HL), and one diagonal less the other (HH), each as a quarter of the
  /// difference plus 128. See fineDetailOf().
  Plane y_lh = Plane(kSize, 128);
  Plane y_hl = Plane(kSize, 128);
  Plane y_hh = Plane(kSize, 128);

 private:
  static constexpr std::size_t kSize = static_cast<std::size_t>(kPictureWidth) * kPictureHeight;
};

/// The colour of one pixel, each value 0..255 but not yet rounded.
struct YCrCb {
  float y;
  float cr;
  float cb;
};

/// @param red, green, blue 0..255, as in files and on screens (not linear)
inline YCrCb toYCrCb(float red, float green, float blue) {
  const float y = 0.299f * red + 0.587f * green + 0.114f * blue;
  return {y, 128 + 0.713267f * (red - y), 128 + 0.564334f * (blue - y)};
}

/// The nearest byte.
inline std::uint8_t toByte(float value) {
  return static_cast<std::uint8_t>(value <= 0 ? 0 : value >= 255 ? 255 : value + 0.5f);
}

/// Fine detail, not yet rounded, without the 128 of the bands.
struct FineDetail {
  float lh;
  float hl;
  float hh;
};

/// The fine detail of four pixels. Sony's sample W3AIBO (JPEGEncoder.cc) shows the inverse: with ll, the mean of the
/// four, the lower right one is ll + lh + hl + hh, the lower left one ll + lh - hl - hh, and so on.
inline FineDetail fineDetailOf(float upper_left, float upper_right, float lower_left, float lower_right) {
  return {(lower_left + lower_right - upper_left - upper_right) / 4,
          (upper_right + lower_right - upper_left - lower_left) / 4,
          (upper_left + lower_right - upper_right - lower_left) / 4};
}

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_YCRCB_IMAGE_H
