#include "support/test_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <stdexcept>

#include "protocol/version1.h"

namespace test_pictures {
namespace {

constexpr unsigned kScenes = 16;      // of named pictures
constexpr std::ptrdiff_t kStart = 2;  // behind SOI
constexpr std::array<std::uint8_t, 8> kComment = {0xFF, 0xFE, 0, 2 + 4 + 16, 'A', 'I', 'B', 'O'};
using NameBytes = std::array<std::uint64_t, 2>;

const Bytes& scene(std::uint64_t number) {
  static const std::vector<Bytes> scenes = [] {
    std::vector<Bytes> all;
    for (unsigned seed = 0; seed < kScenes; ++seed) {
      all.push_back(makeNumbered(seed));
    }
    return all;
  }();
  return scenes[number % kScenes];
}

}  // namespace

Bytes make(const PictureKind& kind) {
  std::vector<unsigned char> rgb(static_cast<std::size_t>(kind.width * kind.height * 3));
  std::minstd_rand random(kind.seed);
  std::uniform_int_distribution<int> noise(-6, 6);
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    const double phase = static_cast<double>(i % static_cast<std::size_t>(3 * kind.width)) / 90.0 + kind.seed;
    rgb[i] = static_cast<unsigned char>(128 + 100 * std::sin(phase) + noise(random));
  }
  const std::unique_ptr<void, int (*)(tjhandle)> compressor(tjInitCompress(), &tjDestroy);
  unsigned char* data = nullptr;
  unsigned long size = 0;
  const int error = tjCompress2(compressor.get(), rgb.data(), kind.width, 0, kind.height, TJPF_RGB, &data, &size,
                                kind.subsampling, kind.quality, kind.flags);
  const std::unique_ptr<unsigned char, void (*)(unsigned char*)> owner(data, &tjFree);
  if (error != 0) {
    throw std::runtime_error(tjGetErrorStr2(compressor.get()));
  }
  return Bytes(data, data + size);
}

Bytes makeNumbered(unsigned seed) {
  return make({208, 160, 85, TJSAMP_420, 0, seed});
}

Bytes makeNamed(const Name& name) {
  const NameBytes bytes = {name.connection, name.number};
  Bytes comment(kComment.begin(), kComment.end());
  comment.resize(kComment.size() + sizeof bytes);
  std::memcpy(&comment[kComment.size()], bytes.data(), sizeof bytes);
  Bytes picture = scene(name.number);
  picture.insert(picture.begin() + kStart, comment.begin(), comment.end());
  return picture;
}

std::optional<Name> nameOf(const Bytes& jpeg) {
  if (jpeg.size() < kStart + kComment.size() + sizeof(NameBytes) ||
      !std::equal(kComment.begin(), kComment.end(), jpeg.begin() + kStart)) {
    return std::nullopt;
  }
  NameBytes bytes = {};
  std::memcpy(bytes.data(), jpeg.data() + kStart + kComment.size(), sizeof bytes);
  return Name{static_cast<std::uint32_t>(bytes[0]), bytes[1]};
}

std::size_t findMarker(const Bytes& jpeg, std::uint8_t marker) {
  for (std::size_t i = 0; i + 1 < jpeg.size(); ++i) {
    if (jpeg[i] == 0xFF && jpeg[i + 1] == marker) {
      return i;
    }
  }
  throw std::runtime_error("no such marker");
}

Bytes makeReply(const Bytes& jpeg) {
  Bytes reply(protocol::PICTURE_HEADER_SIZE);
  protocol::encodePictureHeader(jpeg.size(), reply.data());
  reply.insert(reply.end(), jpeg.begin(), jpeg.end());
  return reply;
}

}  // namespace test_pictures
