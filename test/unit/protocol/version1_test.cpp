#include "protocol/version1.h"

#include <gmock/gmock.h>

#include <array>
#include <vector>

namespace protocol {
namespace {

using ::testing::ElementsAre;

TEST(Version1, SizeOfPictureIsBigEndian) {
  std::array<unsigned char, PICTURE_HEADER_SIZE> bytes{};
  encodePictureHeader(0x00012345, bytes.data());
  EXPECT_THAT(bytes, ElementsAre('f', 0x00, 0x01, 0x23, 0x45));
  size_t size = 0;
  EXPECT_TRUE(decodePictureHeader(bytes.data(), &size));
  EXPECT_EQ(size, 0x00012345U);
}

TEST(Version1, PictureHeaderIsRefusedWhenLetterOrSizeIsImpossible) {
  const std::vector<std::array<unsigned char, PICTURE_HEADER_SIZE>> impossible = {
      {'F', 0, 0, 1, 0}, {'e', 0, 0, 1, 0}, {'f', 0, 0, 0, 0}, {'f', 0, 4, 0, 1}, {'f', 255, 255, 255, 255}};
  for (const auto& bytes : impossible) {
    size_t size = 0;
    EXPECT_FALSE(decodePictureHeader(bytes.data(), &size)) << bytes[0] << " with size " << size;
  }
}

TEST(Version1, ValueIsLittleEndianAndSigned) {
  std::array<unsigned char, VALUE_REPLY_SIZE> bytes{};
  encodeValueReply({'j', 11, -2}, bytes.data());
  EXPECT_THAT(bytes, ElementsAre('j', 11, 0xfe, 0xff));
  const ValueReply reply = decodeValueReply(bytes.data());
  EXPECT_EQ(reply.letter, 'j');
  EXPECT_EQ(reply.identifier, 11);
  EXPECT_EQ(reply.value, -2);
}

TEST(FileRequest, IsANameAndTwoNumbers) {
  unsigned char bytes[FILE_PAYLOAD_SIZE];
  encodeFileRequest(FileRequest{"NOD.MTN", 0x0102, 0xfffe}, bytes);
  EXPECT_THAT(bytes, ElementsAre('N', 'O', 'D', '.', 'M', 'T', 'N', 0, 0, 0, 0, 0, 0x02, 0x01, 0xfe, 0xff));

  const FileRequest file = decodeFileRequest(bytes);
  EXPECT_STREQ(file.name, "NOD.MTN");
  EXPECT_EQ(file.a, 0x0102);
  EXPECT_EQ(file.b, 0xfffe);
}

TEST(FileRequest, EndsItsNameAtTheFirstZeroByteOrAfterTwelve) {
  unsigned char bytes[FILE_PAYLOAD_SIZE];
  encodeFileRequest(FileRequest{"WALK_FWD.MTN", 0xffff, 0xffff}, bytes);
  EXPECT_STREQ(decodeFileRequest(bytes).name, "WALK_FWD.MTN");
  bytes[3] = 0;  // whatever an old client has left behind that
  EXPECT_STREQ(decodeFileRequest(bytes).name, "WAL");
  bytes[0] = 0;
  EXPECT_STREQ(decodeFileRequest(bytes).name, "");
}

}  // namespace
}  // namespace protocol
