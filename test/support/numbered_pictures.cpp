#include "support/numbered_pictures.h"

#include <algorithm>
#include <array>
#include <vector>

#include "support/test_pictures.h"

namespace test_support {
namespace {

constexpr unsigned kScenes = 16;
constexpr std::size_t kStart = 2;  // behind SOI
constexpr std::array<std::uint8_t, 8> kComment = {0xFF, 0xFE, 0, 2 + 4 + 12, 'A', 'I', 'B', 'O'};

const Bytes& scene(std::uint64_t number) {
  static const std::vector<Bytes> scenes = [] {
    std::vector<Bytes> all;
    for (unsigned seed = 0; seed < kScenes; ++seed) {
      all.push_back(test_pictures::makeNumbered(seed));
    }
    return all;
  }();
  return scenes[number % kScenes];
}

void append(std::uint64_t value, int size, Bytes* out) {
  for (int shift = 8 * (size - 1); shift >= 0; shift -= 8) {
    out->push_back(static_cast<std::uint8_t>(value >> shift & 0xFF));
  }
}

std::uint64_t read(const std::uint8_t* in, int size) {
  std::uint64_t value = 0;
  for (int i = 0; i < size; ++i) {
    value = value << 8 | in[i];
  }
  return value;
}

}  // namespace

Bytes makeNumberedPicture(const PictureName& name) {
  const Bytes& jpeg = scene(name.number);
  Bytes picture;
  picture.reserve(jpeg.size() + kComment.size() + 12);
  picture.assign(jpeg.begin(), jpeg.begin() + kStart);
  picture.insert(picture.end(), kComment.begin(), kComment.end());
  append(name.connection, 4, &picture);
  append(name.number, 8, &picture);
  picture.insert(picture.end(), jpeg.begin() + kStart, jpeg.end());
  return picture;
}

std::optional<PictureName> nameOfPicture(const Bytes& jpeg) {
  if (jpeg.size() < kStart + kComment.size() + 12 ||
      !std::equal(kComment.begin(), kComment.end(), jpeg.begin() + kStart)) {
    return std::nullopt;
  }
  const std::uint8_t* const name = jpeg.data() + kStart + kComment.size();
  return PictureName{static_cast<std::uint32_t>(read(name, 4)), read(name + 4, 8)};
}

}  // namespace test_support
