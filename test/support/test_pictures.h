/// @file test_pictures.h
/// Real JPEGs, both as a camera sends them and unusual ones.
#ifndef TEST_SUPPORT_TEST_PICTURES_H
#define TEST_SUPPORT_TEST_PICTURES_H

#include <turbojpeg.h>

#include <cstddef>
#include <cstdint>
#include <optional>
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

/// Identifies a picture among all that a server has sent.
struct Name {
  std::uint32_t connection = 0;  ///< over which it was sent; the first is 1
  std::uint64_t number = 0;      ///< of the picture; the first is 1
};

/// A picture with its name in a comment. It is always the same for the same name, so a receiver can check every byte.
Bytes makeNamed(const Name& name);

/// The name in the comment; nothing if there is none.
std::optional<Name> nameOf(const Bytes& jpeg);

/// The index of this marker's 0xFF. The picture must have the marker.
std::size_t findMarker(const Bytes& jpeg, std::uint8_t marker);

/// A whole reply of version 1: header and picture.
Bytes makeReply(const Bytes& jpeg);

}  // namespace test_pictures

#endif  // TEST_SUPPORT_TEST_PICTURES_H
