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
inline std::vector<test_pictures::Bytes> makeDatagrams(const test_pictures::Bytes& jpeg, unsigned picture,
                                                       unsigned frame_number, unsigned* sequence) {
  using namespace protocol::version2;
  std::vector<test_pictures::Bytes> datagrams;
  for (std::size_t part = 0; part < numberOfParts(jpeg.size()); ++part) {
    PictureDatagram header = {};
    header.part = static_cast<unsigned short>(part);
    header.sequence = (*sequence)++;
    header.picture = picture;
    header.jpeg_size = static_cast<unsigned>(jpeg.size());
    header.image = {picture, frame_number, 208, 160, 85, LAYER_HIGH, {}};
    test_pictures::Bytes datagram(DATAGRAM_HEADER_SIZE);
    encodePictureDatagram(header, datagram.data());
    const auto begin = jpeg.begin() + static_cast<std::ptrdiff_t>(part * DATAGRAM_PART_SIZE);
    datagram.insert(datagram.end(), begin, begin + static_cast<std::ptrdiff_t>(sizeOfPart(jpeg.size(), part)));
    datagrams.push_back(datagram);
  }
  return datagrams;
}

}  // namespace test_support

#endif  // TEST_SUPPORT_PICTURE_DATAGRAMS_H
