/// @file picture_datagrams.h
/// Pictures as datagrams, for tests.
#ifndef TEST_SUPPORT_PICTURE_DATAGRAMS_H
#define TEST_SUPPORT_PICTURE_DATAGRAMS_H

#include <vector>

#include "protocol/picture_datagram.h"
#include "support/test_pictures.h"

namespace test_support {

/// The datagrams of a picture, as a robot sends them.
/// @param picture its number
/// @param[in,out] sequence the number of its first datagram; afterwards that of the next picture's
/// @param with_parities each group of parts is followed by their parity
inline std::vector<test_pictures::Bytes> makeDatagrams(const test_pictures::Bytes& jpeg, unsigned picture,
                                                       unsigned frame_number, unsigned* sequence,
                                                       bool with_parities = false) {
  using namespace protocol::version2;
  std::vector<test_pictures::Bytes> datagrams;
  test_pictures::Bytes parity;
  PictureDatagram header = {};
  header.picture = picture;
  header.jpeg_size = static_cast<unsigned>(jpeg.size());
  header.image = {picture + 12345, frame_number, 208, 160, 85, LAYER_HIGH, {}};
  const auto add = [&](const test_pictures::Bytes& content) {
    header.sequence = (*sequence)++;
    test_pictures::Bytes datagram(DATAGRAM_HEADER_SIZE);
    encode(header, datagram.data());
    datagram.insert(datagram.end(), content.begin(), content.end());
    datagrams.push_back(datagram);
  };
  for (std::size_t part = 0; part < numberOfParts(jpeg.size()); ++part) {
    const auto begin = jpeg.begin() + static_cast<std::ptrdiff_t>(part * DATAGRAM_PART_SIZE);
    const test_pictures::Bytes content(begin, begin + static_cast<std::ptrdiff_t>(sizeOfPart(jpeg.size(), part)));
    header.is_parity = false;
    header.part = static_cast<unsigned short>(part);
    add(content);
    if (part % PARTS_PER_PARITY == 0) {
      parity.assign(content.size(), 0);
    }
    addToParity(content.data(), content.size(), parity.data());
    if (with_parities && ((part + 1) % PARTS_PER_PARITY == 0 || part + 1 == numberOfParts(jpeg.size()))) {
      header.is_parity = true;
      header.part = static_cast<unsigned short>(part / PARTS_PER_PARITY * PARTS_PER_PARITY);
      add(parity);
    }
  }
  return datagrams;
}

}  // namespace test_support

#endif  // TEST_SUPPORT_PICTURE_DATAGRAMS_H
