/// @file test_pictures.h
/// Real JPEGs, as a camera would send them and as it would not.
#ifndef TEST_SUPPORT_TEST_PICTURES_H
#define TEST_SUPPORT_TEST_PICTURES_H

#include <turbojpeg.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace test_pictures {

using Bytes = std::vector<std::uint8_t>;

struct PictureKind {
  int width = 208;
  int height = 160;
  int quality = 85;
  int subsampling = TJSAMP_420;
  int flags = 0;      ///< TJFLAG_PROGRESSIVE...
  unsigned seed = 1;  ///< pictures of different seeds differ
};

/// A smooth scene with some noise, compressed by TurboJPEG.
Bytes make(const PictureKind& kind = PictureKind());

/// An ordinary picture, different for each seed.
Bytes makeNumbered(unsigned seed);

/// Where the segment of this marker begins: at its 0xFF. The picture must have it.
std::size_t findMarker(const Bytes& jpeg, std::uint8_t marker);

/// A whole reply: header and picture.
Bytes makeReply(const Bytes& jpeg);

}  // namespace test_pictures

#endif  // TEST_SUPPORT_TEST_PICTURES_H
