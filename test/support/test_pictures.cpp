#include "support/test_pictures.h"

#include <cmath>
#include <memory>
#include <random>
#include <stdexcept>

#include "protocol/version1.h"

namespace test_pictures {

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
  PictureKind kind;
  kind.seed = seed;
  return make(kind);
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
