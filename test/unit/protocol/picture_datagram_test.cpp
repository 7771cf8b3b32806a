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
  const PictureDatagram value = {false, 1, 7, 3, 1344, {66051, 168496141, 208, 160, 85, LAYER_HIGH, {}}};
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
  EXPECT_THAT(problemOf(with(bytes, 1, 2)), HasSubstr("begin"));
  EXPECT_THAT(problemOf(with(bytes, 1, 1)), HasSubstr("first one of a group")) << "a parity of group 0 names part 0";
  EXPECT_THAT(problemOf(with(bytes, 3, 2)), HasSubstr("that many parts"));
  EXPECT_THAT(problemOf(with(bytes, 3, 0)), HasSubstr("size of its part"));
  EXPECT_THAT(problemOf(with(bytes, 12, 0x7f)), HasSubstr("too large"));
  EXPECT_THAT(problemOf(with(with(bytes, 14, 0), 15, 0)), HasSubstr("empty"));
  EXPECT_THAT(problemOf(with(bytes, 28, 101)), HasSubstr("quality"));
  EXPECT_THAT(problemOf(with(bytes, 29, 9)), HasSubstr("layer"));
}

TEST(PictureDatagram, AParityIsAsLongAsTheFirstPartOfItsGroup) {
  Bytes bytes = with(with(hex(kHeader), 1, 1), 3, 0);
  EXPECT_THAT(problemOf(bytes + Bytes(4, 7)), HasSubstr("size of its part"));
  bytes = bytes + Bytes(DATAGRAM_PART_SIZE, 7);
  PictureDatagram datagram{};
  ASSERT_THAT(decodePictureDatagram(bytes.data(), bytes.size(), &datagram), IsNull());
  EXPECT_TRUE(datagram.is_parity);
  EXPECT_EQ(encoded(datagram), firstOf(bytes, DATAGRAM_HEADER_SIZE));
}

TEST(Parity, OfAGroupGivesBackAnyPartOfIt) {
  EXPECT_EQ(numberOfParities(1), 1U);
  EXPECT_EQ(numberOfParities(8), 1U);
  EXPECT_EQ(numberOfParities(9), 2U);
  const std::vector<Bytes> parts = {hex("01 02 03 04"), hex("ff 00 ff 00"), hex("55 aa")};
  for (size_t lost = 0; lost < parts.size(); ++lost) {
    Bytes sum(4);
    for (const Bytes& part : parts) {
      addToParity(part.data(), part.size(), sum.data());
    }
    for (size_t i = 0; i < parts.size(); ++i) {
      if (i != lost) {
        addToParity(parts[i].data(), parts[i].size(), sum.data());
      }
    }
    EXPECT_EQ(firstOf(sum, parts[lost].size()), parts[lost]);
  }
}

}  // namespace
}  // namespace version2
}  // namespace protocol
