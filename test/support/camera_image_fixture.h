/// @file camera_image_fixture.h
/// Camera images in the robot's memory layout, for tests and benchmarks of the encoder.
#ifndef TEST_SUPPORT_CAMERA_IMAGE_FIXTURE_H
#define TEST_SUPPORT_CAMERA_IMAGE_FIXTURE_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "picture_encoder/CameraImage.h"

namespace test_support {

/// Owns the bytes of a CameraImage: rows of Y, Cr, Cb and three more bands in turn, as on the ERS-7 (stride 6 x width).
class CameraImageFixture {
 public:
  struct Pixel {
    uint8_t y;
    uint8_t cb;
    uint8_t cr;
  };

  /// Calls `pixel(x, y)` for each pixel.
  CameraImageFixture(size_t width, size_t height, const std::function<Pixel(size_t, size_t)>& pixel)
      : width_(width), height_(height), bytes_(6 * width * height, 0xaa) {
    for (size_t y = 0; y < height; ++y) {
      uint8_t* row = bytes_.data() + 6 * width * y;
      for (size_t x = 0; x < width; ++x) {
        const Pixel value = pixel(x, y);
        row[x] = value.y;
        row[width + x] = value.cr;
        row[2 * width + x] = value.cb;
      }
    }
  }

  /// Smooth shading with some sensor noise, as in real pictures of the ERS-7: 4 to 6 KB at quality 85.
  static CameraImageFixture scene(size_t width = 208, size_t height = 160, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, 1.5);
    return CameraImageFixture(width, height, [&](size_t column, size_t row) {
      const double x = static_cast<double>(column);
      const double y = static_cast<double>(row);
      const double edge = std::fmod(x + 0.5 * y, 40) < 20 ? 10 : -10;
      return Pixel{level(120 + 50 * std::sin(x / 31) + 30 * std::cos(y / 19) + edge + noise(random)),
                   level(120 + 30 * std::cos((x - y) / 25) + noise(random)),
                   level(128 + 40 * std::sin((x + y) / 30) + noise(random))};
    });
  }

  CameraImage image() const {
    return {bytes_.data(), bytes_.data() + width_, bytes_.data() + 2 * width_, width_, height_, 6 * width_};
  }

  /// Writes the bands of fine detail, which are at first nonsense.
  /// @param band called with 3 for LH, 4 for HL, 5 for HH, and x and y
  void setDetail(const std::function<uint8_t(size_t, size_t, size_t)>& band) {
    for (size_t y = 0; y < height_; ++y) {
      for (size_t i = 3 * width_; i < 6 * width_; ++i) {
        bytes_[6 * width_ * y + i] = band(i / width_, i % width_, y);
      }
    }
  }

  DetailBands detail() const {
    return {bytes_.data() + 3 * width_, bytes_.data() + 4 * width_, bytes_.data() + 5 * width_};
  }

  /// Writes the camera's 16 tag bytes at the beginning of the last row, in all bands.
  void setTag(uint8_t value, uint16_t field_counter) {
    uint8_t* row = bytes_.data() + 6 * width_ * (height_ - 1);
    for (size_t band = 0; band < 3; ++band) {
      uint8_t* tag = row + band * width_;
      std::fill(tag, tag + CameraImage::TAG_SIZE, value);
      tag[0] = static_cast<uint8_t>(field_counter & 0xff);
      tag[1] = static_cast<uint8_t>(field_counter >> 8);
    }
  }

  const std::vector<uint8_t>& bytes() const { return bytes_; }

 private:
  static uint8_t level(double value) { return static_cast<uint8_t>(value < 0 ? 0 : value > 255 ? 255 : value); }

  size_t width_;
  size_t height_;
  std::vector<uint8_t> bytes_;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_CAMERA_IMAGE_FIXTURE_H
