#include "protocol/picture_datagram.h"

#include <gmock/gmock.h>

#include "layouts.h"

namespace protocol {
namespace version2 {
namespace {

using ::testing::HasSubstr;
using ::testing::IsNull;

constexpr char kHeader[] =
    "62 00 00 01 00 00 00 07 "  // part 1, sequence 7
    "00 00 00 03 00 00 05 40 "  // picture 3, of 1344 bytes
    "00 01 02 03 0a 0b 0c 0d "  // image 66051, frame 168496141
    "00 d0 00 a0 55 00 00 00";  // 208x160, quality 85, layer H

Bytes lastPart() {
  return hex(kHeader) + hex("01 02 03 04");
}

const char* problemOf(const Bytes& bytes) {
  PictureDatagram datagram{};
  return decodePictureDatagram(bytes.data(), bytes.size(), &datagram);
}

Bytes with(Bytes bytes, size_t index, unsigned char value) {
  bytes[index] = value;
  return bytes;
}

TEST(PictureDatagram, HasTheLayoutOfTheDocument) {
  const PictureDatagram value = {1, 7, 3, 1344, {66051, 168496141, 208, 160, 85, LAYER_HIGH, {}}};
  EXPECT_EQ(encoded(value), hex(kHeader));
  const Bytes bytes = lastPart();
  PictureDatagram datagram{};
  ASSERT_THAT(decodePictureDatagram(bytes.data(), bytes.size(), &datagram), IsNull());
  EXPECT_EQ(encoded(datagram), hex(kHeader));
}

TEST(PictureDatagram, OfATestHasTheNumbersOfItsOrderAndOtherwiseZeros) {
  Bytes bytes(MAX_DATAGRAM_SIZE, 7);
  encodeTest({54321, true, 0x12345678, 0x9abcdef0}, bytes.data());
  EXPECT_EQ(bytes, hex("62 00 00 00 12 34 56 78 9a bc de f0") + Bytes(1360));
  EXPECT_THAT(problemOf(bytes), HasSubstr("empty")) << "it is no part of a picture";
}

TEST(PictureDatagram, CutOrPaddedOnesAreRefused) {
  const Bytes bytes = lastPart();
  for (size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_NE(problemOf(firstOf(bytes, size)), nullptr) << size;
  }
  EXPECT_THAT(problemOf(bytes + hex("00")), HasSubstr("size of its part"));
}

TEST(PictureDatagram, ImpossibleOnesAreRefused) {
  const Bytes bytes = lastPart();
  EXPECT_THAT(problemOf(with(bytes, 0, 'f')), HasSubstr("begin"));
  EXPECT_THAT(problemOf(with(bytes, 1, 1)), HasSubstr("reserved"));
  EXPECT_THAT(problemOf(with(bytes, 3, 2)), HasSubstr("that many parts"));
  EXPECT_THAT(problemOf(with(bytes, 3, 0)), HasSubstr("size of its part"));
  EXPECT_THAT(problemOf(with(bytes, 12, 0x7f)), HasSubstr("too large"));
  EXPECT_THAT(problemOf(with(with(bytes, 14, 0), 15, 0)), HasSubstr("empty"));
  EXPECT_THAT(problemOf(with(bytes, 28, 101)), HasSubstr("quality"));
  EXPECT_THAT(problemOf(with(bytes, 29, 9)), HasSubstr("layer"));
}

}  // namespace
}  // namespace version2
}  // namespace protocol
