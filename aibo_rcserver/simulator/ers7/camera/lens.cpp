#include "simulator/ers7/camera/lens.h"

#include <algorithm>
#include <cmath>

#include "simulator/ers7/camera/camera_optics.h"

namespace simulated_ers7 {
namespace {

constexpr std::size_t kWidth = kPictureWidth;
constexpr std::size_t kHeight = kPictureHeight;

/// The light that is left in the corners.
const Color kCornerLight(0.70, 0.74, 0.80);

/// Share of its light that a pixel gives to each of its neighbours.
constexpr double kBlur = 0.20;

Color blurred(const Color& before, const Color& here, const Color& after) {
  return (1 - 2 * kBlur) * here + kBlur * (before + after);
}

LightImage makeTransmission() {
  LightImage transmission;
  const double corner = std::hypot(kPictureWidth / 2.0, kPictureHeight / 2.0);
  for (int y = 0; y < kPictureHeight; ++y) {
    for (int x = 0; x < kPictureWidth; ++x) {
      const double radius = std::hypot(x + 0.5 - kPictureWidth / 2.0, y + 0.5 - kPictureHeight / 2.0) / corner;
      transmission.push_back(1 - radius * radius * (1 - kCornerLight));
    }
  }
  return transmission;
}

}  // namespace

Lens::Lens() : transmission_(makeTransmission()), blurred_across_(kWidth * kHeight), projected_(kWidth * kHeight) {}

const LightImage& Lens::project(const LightImage& light) {
  for (std::size_t y = 0; y < kHeight; ++y) {
    const Color* row = &light[y * kWidth];
    Color* out = &blurred_across_[y * kWidth];
    out[0] = blurred(row[0], row[0], row[1]);
    for (std::size_t x = 1; x < kWidth - 1; ++x) {
      out[x] = blurred(row[x - 1], row[x], row[x + 1]);
    }
    out[kWidth - 1] = blurred(row[kWidth - 2], row[kWidth - 1], row[kWidth - 1]);
  }
  for (std::size_t y = 0; y < kHeight; ++y) {
    const Color* here = &blurred_across_[y * kWidth];
    const Color* above = y > 0 ? here - kWidth : here;
    const Color* below = y < kHeight - 1 ? here + kWidth : here;
    for (std::size_t x = 0; x < kWidth; ++x) {
      const std::size_t i = y * kWidth + x;
      projected_[i] = blurred(above[x], here[x], below[x]) * transmission_[i];
    }
  }
  return projected_;
}

}  // namespace simulated_ers7
