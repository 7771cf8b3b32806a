/// @file picture_checks.h
/// Checks of the content and the quality of a JPEG.
#ifndef TEST_UNIT_RCSERVER_PICTURE_CHECKS_H
#define TEST_UNIT_RCSERVER_PICTURE_CHECKS_H

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

/// The first number of the JPEG's first quantisation table, which depends on its quality: libjpeg sets it to 16 at
/// quality 50, and lower above.
inline int quantizerOf(const std::vector<uint8_t>& jpeg) {
  const std::vector<uint8_t> marker = {0xff, 0xdb};
  const auto table = std::search(jpeg.begin(), jpeg.end(), marker.begin(), marker.end());
  return jpeg.end() - table > 5 ? table[5] : -1;
}

inline int quantizerFor(int quality) {
  const int scale = quality < 50 ? 5000 / quality : 200 - 2 * quality;
  return std::max(1, (16 * scale + 50) / 100);
}

struct Brightness {
  int width = 0;
  int height = 0;
  int level = -1;
  int bottom = -1;  ///< level of the last row
};

inline Brightness brightnessOf(const std::vector<uint8_t>& jpeg) {
  const std::unique_ptr<void, int (*)(tjhandle)> handle(tjInitDecompress(), tjDestroy);
  Brightness brightness;
  int subsampling = 0;
  int colorspace = 0;
  tjDecompressHeader3(handle.get(), jpeg.data(), jpeg.size(), &brightness.width, &brightness.height, &subsampling,
                      &colorspace);
  std::vector<uint8_t> gray(static_cast<size_t>(brightness.width * brightness.height));
  if (tjDecompress2(handle.get(), jpeg.data(), jpeg.size(), gray.data(), brightness.width, 0, brightness.height,
                    TJPF_GRAY, TJFLAG_STOPONWARNING) == 0) {
    brightness.level = gray[static_cast<size_t>(brightness.height / 2 * brightness.width)];
    brightness.bottom = gray.back();
  }
  return brightness;
}

#endif  // TEST_UNIT_RCSERVER_PICTURE_CHECKS_H
