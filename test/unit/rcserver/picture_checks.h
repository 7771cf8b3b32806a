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

/// Of a decoded picture, at full resolution, chroma too.
struct Decoded {
  int width = 0;
  int height = 0;
  int subsampling = -1;
  int colorspace = -1;
  std::vector<uint8_t> rgb;

  int level() const { return rgb[static_cast<size_t>(3 * (height / 2 * width))]; }  ///< of a grey one, in the middle
  int bottom() const { return rgb.back(); }                                         ///< in the last row
};

inline Decoded decodeJpeg(const std::vector<uint8_t>& jpeg) {
  const std::unique_ptr<void, int (*)(tjhandle)> handle(tjInitDecompress(), tjDestroy);
  Decoded decoded;
  EXPECT_EQ(tjDecompressHeader3(handle.get(), jpeg.data(), jpeg.size(), &decoded.width, &decoded.height,
                                &decoded.subsampling, &decoded.colorspace),
            0);
  decoded.rgb.resize(static_cast<size_t>(3 * decoded.width * decoded.height));
  EXPECT_EQ(tjDecompress2(handle.get(), jpeg.data(), jpeg.size(), decoded.rgb.data(), decoded.width, 0, decoded.height,
                          TJPF_RGB, TJFLAG_STOPONWARNING),
            0)
      << tjGetErrorStr2(handle.get());
  return decoded;
}

#endif  // TEST_UNIT_RCSERVER_PICTURE_CHECKS_H
