/// @file numbered_pictures.h
#ifndef TEST_SUPPORT_NUMBERED_PICTURES_H
#define TEST_SUPPORT_NUMBERED_PICTURES_H

#include <cstdint>
#include <optional>

#include "support/proxy/fault.h"

namespace test_support {

/// Identifies a picture among all that a server has sent.
struct PictureName {
  std::uint32_t connection = 0;  ///< over which it was sent; the first is 1
  std::uint64_t number = 0;      ///< of the picture; the first is 1
};

/// A real JPEG with its name in a comment. It is always the same for the same name, so a receiver can check every byte.
Bytes makeNumberedPicture(const PictureName& name);

/// The name in the comment; nothing if there is none.
std::optional<PictureName> nameOfPicture(const Bytes& jpeg);

}  // namespace test_support

#endif  // TEST_SUPPORT_NUMBERED_PICTURES_H
