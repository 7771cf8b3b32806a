/// @file ycrcb_image.h
/// A picture of layer H's size in the camera's colours, with its fine detail.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_YCRCB_IMAGE_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_YCRCB_IMAGE_H

#include <cmath>
#include <cstdint>
#include <vector>

namespace simulated_ers7 {

/// The size of layer H, in pixels. A place in the picture is measured from its upper left corner, x to the right and y
/// down, so the centre of the first pixel is at (0.5, 0.5).
constexpr int kPictureWidth = 208;
constexpr int kPictureHeight = 160;

/// The field of view in degrees (Sony, Model Information ERS-7). The camera is an ideal pinhole.
constexpr double kHorizontalFieldOfView = 56.9;
constexpr double kVerticalFieldOfView = 45.2;

/// The focal lengths in pixels, from the field of view: 191.9 and 192.2.
inline const double kFocalLengthX = kPictureWidth / 2.0 / std::tan(kHorizontalFieldOfView / 2 * std::acos(-1.0) / 180);
inline const double kFocalLengthY = kPictureHeight / 2.0 / std::tan(kVerticalFieldOfView / 2 * std::acos(-1.0) / 180);

/// Planes of kPictureWidth x kPictureHeight bytes, row by row from the upper left, in the full-range colours of JPEG
/// files (ITU-R BT.601): Y 0..255; Cr and Cb 128 for grey.
struct YCrCbImage {
  using Plane = std::vector<std::uint8_t>;

  Plane y = Plane(kSize);
  Plane cr = Plane(kSize);
  Plane cb = Plane(kSize);

  /// The difference between Y and the luminance at twice the width and height. For each four pixels: lower minus upper
  /// ones (LH), right minus left ones (HL), and one diagonal minus the other (HH), each as a quarter of the difference
  /// plus 128. See fineDetailOf().
  Plane y_lh = Plane(kSize, 128);
  Plane y_hl = Plane(kSize, 128);
  Plane y_hh = Plane(kSize, 128);

 private:
  static constexpr std::size_t kSize = static_cast<std::size_t>(kPictureWidth) * kPictureHeight;
};

/// A colour: 0..255 each, not rounded.
struct YCrCb {
  float y;
  float cr;
  float cb;
};

/// @param red, green, blue 0..255, not linear, but as in files and on screens
inline YCrCb toYCrCb(float red, float green, float blue) {
  const float y = 0.299f * red + 0.587f * green + 0.114f * blue;
  return {y, 128 + 0.713267f * (red - y), 128 + 0.564334f * (blue - y)};
}

inline std::uint8_t toByte(float value) {
  return static_cast<std::uint8_t>(value <= 0 ? 0 : value >= 255 ? 255 : value + 0.5f);
}

/// Fine detail, not rounded, and without the 128 of the bands.
struct FineDetail {
  float lh;
  float hl;
  float hh;
};

/// Sony's sample W3AIBO (JPEGEncoder.cc) shows the inverse: with ll, the mean of the four, the lower right pixel is ll
/// + lh + hl + hh, the lower left one ll + lh - hl - hh, and so on.
inline FineDetail fineDetailOf(float upper_left, float upper_right, float lower_left, float lower_right) {
  return {(lower_left + lower_right - upper_left - upper_right) / 4,
          (upper_right + lower_right - upper_left - lower_left) / 4,
          (upper_left + lower_right - upper_right - lower_left) / 4};
}

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_YCRCB_IMAGE_H
