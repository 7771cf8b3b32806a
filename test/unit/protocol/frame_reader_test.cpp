#include "protocol/frame_reader.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "layouts.h"

namespace protocol {
namespace version2 {
namespace {

class FrameReaderTest : public ::testing::Test {
 protected:
  static constexpr size_t kCapacity = 1000;

  // All frames in the bytes, encoded again; fails if one is too large.
  Bytes receive(const Bytes& bytes) {
    Bytes frames;
    for (size_t used = 0; used < bytes.size();) {
      size_t taken = 0;
      const FrameReader::Result result = reader_.append(bytes.data() + used, bytes.size() - used, &taken);
      EXPECT_NE(result, FrameReader::FRAME_TOO_LARGE);
      EXPECT_GT(taken, 0U);
      used += taken;
      if (result == FrameReader::FRAME_COMPLETE) {
        const unsigned char* payload = reader_.payload();
        frames = frames + encoded(reader_.header()) + Bytes(payload, payload + reader_.header().payload_size);
      }
    }
    return frames;
  }

  Bytes buffer_ = Bytes(kCapacity);
  FrameReader reader_{buffer_.data(), buffer_.size()};
};

TEST_F(FrameReaderTest, RefusesFourGibibytesWithoutTouchingMemory) {
  const Bytes bytes = hex("66 00 00 00 ff ff ff ff") + Bytes(kCapacity + 1, 0x11);
  size_t taken = 0;
  EXPECT_EQ(reader_.append(bytes.data(), bytes.size(), &taken), FrameReader::FRAME_TOO_LARGE);
  EXPECT_EQ(taken, bytes.size());
  EXPECT_THAT(buffer_, ::testing::Each(0));
}

TEST_F(FrameReaderTest, FindsTheSameFramesHoweverTheBytesAreSplitOrJoined) {
  std::mt19937 random(20061);
  const auto upTo = [&random](size_t limit) { return std::uniform_int_distribution<size_t>(0, limit)(random); };
  Bytes bytes;
  for (int i = 0; i < 200; ++i) {
    Bytes payload(i % 3 == 0 ? upTo(kCapacity) : upTo(12));
    std::generate(payload.begin(), payload.end(), [&] { return static_cast<unsigned char>(upTo(255)); });
    const FrameHeader header = {"HFWJVTfte"[upTo(8)], static_cast<unsigned char>(upTo(255)),
                                static_cast<unsigned short>(upTo(65535)), static_cast<unsigned>(payload.size())};
    bytes = bytes + encoded(header) + payload;
  }
  for (const size_t longest_piece : {1U, 2U, 7U, 8U, 9U, 100U, 1460U, 1000000U}) {
    Bytes found;
    for (size_t used = 0; used < bytes.size();) {
      const size_t size = std::min(1 + upTo(longest_piece - 1), bytes.size() - used);
      const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(used);
      found = found + receive(Bytes(begin, begin + static_cast<std::ptrdiff_t>(size)));
      used += size;
    }
    EXPECT_TRUE(found == bytes) << "in pieces of up to " << longest_piece;
  }
}

TEST(Version2, IsAgreedToByItsReplyAlone) {
  EXPECT_TRUE(agreesToVersion2(versionReply()));
  EXPECT_FALSE(agreesToVersion2({'e', 0, ERROR_REFUSED}));
  EXPECT_FALSE(agreesToVersion2({'e', 2, 0}));
  EXPECT_FALSE(agreesToVersion2({'x', 1, 0}));
  EXPECT_FALSE(agreesToVersion2({'x', 2, 1}));
}

TEST(FrameHeader, IsEightBytesBigEndian) {
  EXPECT_EQ(encoded(FrameHeader{'W', 85, 0x0102, 0x03040506}), hex("57 55 01 02 03 04 05 06"));
  EXPECT_EQ(encoded(decodeFrameHeader(hex("66 ff fe 01 ff 00 00 02").data())), hex("66 ff fe 01 ff 00 00 02"));
}

TEST(FrameHeader, OfAReplyToAPostureIsNoError) {
  EXPECT_EQ(replyKind(REQUEST_POSTURE), ERROR_MESSAGE);
  EXPECT_FALSE(isError('e', 0));
  EXPECT_TRUE(isError('e', 1));  // too short, but that is for its decoder to say
  EXPECT_TRUE(isError('e', 2));
  EXPECT_FALSE(isError('s', 8));
}

TEST(Expiry, IsJudgedWhereFramesOverflow) {
  EXPECT_FALSE(isTooOld(1000, 1000));
  EXPECT_TRUE(isTooOld(1000, 1001));
  EXPECT_FALSE(isTooOld(5, 0xfffffff0));
  EXPECT_TRUE(isTooOld(0xfffffff0, 5));
  EXPECT_FALSE(isTooOld(NEVER_TOO_OLD, 5));
  EXPECT_FALSE(isTooOld(NEVER_TOO_OLD, 0x7fffffff));
  EXPECT_EQ(notAfter(0xffffffff - 62, 62), 0U) << "it would be never";
  EXPECT_EQ(notAfter(0xffffffff, 62), 61U);
}

TEST(Texts, AreCutAfterAWholeCharacter) {
  const std::string text(MAX_ERROR_TEXT_SIZE - 1, 'a');
  const std::string longer = text + "\xc3\xa9";
  EXPECT_EQ(encoded(ErrorMessage{0, longer.data(), longer.size()}), hex("00 00") + bytesOf(text));

  const std::string name(MAX_END_NAME_SIZE - 1, 'n');
  const std::string long_name = name + "\xc3\xa9";
  EXPECT_EQ(encoded(EndMessage{ENDED_MOTION, END_REPLACED, 0, long_name.data(), long_name.size(), longer.data(),
                               longer.size()}),
            hex("01 01 00 00") + bytesOf(name + "\n" + text));
}

}  // namespace
}  // namespace version2
}  // namespace protocol
