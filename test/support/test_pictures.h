/// @file test_pictures.h
/// Real JPEGs, both as a camera sends them and unusual ones.
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
  unsigned seed = 1;  ///< pictures with different seeds differ
};

/// A smooth scene with some noise, compressed by TurboJPEG.
Bytes make(const PictureKind& kind = PictureKind());

/// An ordinary picture, different for each seed.
Bytes makeNumbered(unsigned seed);

/// The index of this marker's 0xFF. The picture must have the marker.
std::size_t findMarker(const Bytes& jpeg, std::uint8_t marker);

/// A whole reply of version 1: header and picture.
Bytes makeReply(const Bytes& jpeg);

}  // namespace test_pictures

#endif  // TEST_SUPPORT_TEST_PICTURES_H
