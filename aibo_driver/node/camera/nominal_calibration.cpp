#include "node/camera/nominal_calibration.h"

#include <cmath>
#include <cstddef>

namespace aibo_driver::node {
namespace {

double focalLength(std::uint32_t pixels, double degrees) {
  const double half_angle = degrees / 2 * std::acos(-1.0) / 180;
  return pixels / 2.0 / std::tan(half_angle);
}

// The middle of a picture. The centre of the first pixel is at 0, not at 0.5.
double middle(std::uint32_t pixels) {
  return (pixels - 1) / 2.0;
}

bool isMultiple(std::uint32_t width, std::uint32_t height, std::uint32_t of_width, std::uint32_t of_height) {
  return width > 0 && of_width > 0 && of_height > 0 && width % of_width == 0 && height % of_height == 0 &&
         width / of_width == height / of_height;
}

// Scales one row of a camera matrix.
void scaleRow(double factor, std::size_t centre, std::size_t length, double* row) {
  for (std::size_t i = 0; i < length; ++i) {
    row[i] *= factor;
  }
  row[centre] += (factor - 1) / 2;  // the outer edge of the first pixel stays at -0.5
}

}  // namespace

sensor_msgs::CameraInfo nominalCalibration(const std::string& design, std::uint32_t width, std::uint32_t height) {
  const bool ers210 = design == "ERS-210";
  const double fx = focalLength(width, ers210 ? 57.6 : 56.9);
  const double fy = focalLength(height, ers210 ? 47.8 : 45.2);
  const double cx = middle(width);
  const double cy = middle(height);
  sensor_msgs::CameraInfo info;
  info.width = width;
  info.height = height;
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K = {fx, 0, cx, 0, fy, cy, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {fx, 0, cx, 0, 0, fy, cy, 0, 0, 0, 1, 0};
  return info;
}

std::optional<sensor_msgs::CameraInfo> scaleCalibration(const sensor_msgs::CameraInfo& info, std::uint32_t width,
                                                        std::uint32_t height) {
  if (info.width == width && info.height == height) {
    return info;
  }
  if (!isMultiple(width, height, info.width, info.height) && !isMultiple(info.width, info.height, width, height)) {
    return std::nullopt;
  }
  const double factor = static_cast<double>(width) / info.width;
  sensor_msgs::CameraInfo scaled = info;
  scaled.width = width;
  scaled.height = height;
  scaleRow(factor, 2, 3, &scaled.K[0]);
  scaleRow(factor, 2, 3, &scaled.K[3]);
  scaleRow(factor, 2, 4, &scaled.P[0]);
  scaleRow(factor, 2, 4, &scaled.P[4]);
  return scaled;
}

}  // namespace aibo_driver::node
