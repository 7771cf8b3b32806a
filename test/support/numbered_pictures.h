/// @file numbered_pictures.h
#ifndef TEST_SUPPORT_NUMBERED_PICTURES_H
#define TEST_SUPPORT_NUMBERED_PICTURES_H

#include <cstdint>
#include <optional>

#include "support/proxy/fault.h"

namespace test_support {

/// Which picture it is, of all that a server has sent.
struct PictureName {
  std::uint32_t connection = 0;  ///< over which it was sent; the first is 1
  std::uint64_t number = 0;      ///< of the picture; the first is 1
};

/// A real JPEG that is like no other: a comment in it says which one it is. Always the same for the same name, so that
/// who gets it can tell whether all of it is as it was sent.
Bytes makeNumberedPicture(const PictureName& name);

/// What the comment says; nothing if there is none.
std::optional<PictureName> nameOfPicture(const Bytes& jpeg);

}  // namespace test_support

#endif  // TEST_SUPPORT_NUMBERED_PICTURES_H
