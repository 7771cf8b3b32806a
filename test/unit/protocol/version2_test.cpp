#include "protocol/version2.h"

#include <gmock/gmock.h>

#include <string>

#include "layouts.h"

namespace protocol {
namespace version2 {
namespace {

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
