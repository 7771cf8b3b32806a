#include "protocol/version2.h"

#include <gmock/gmock.h>

#include <string>

#include "layouts.h"

namespace protocol {
namespace version2 {
namespace {

using ::testing::HasSubstr;
using ::testing::IsNull;
using ::testing::NotNull;

TEST(Version2, IsAgreedToByItsReplyAlone) {
  EXPECT_TRUE(agreesToVersion2(versionReply()));
  EXPECT_FALSE(agreesToVersion2({'e', 0, ERROR_REFUSED}));
  EXPECT_FALSE(agreesToVersion2({'e', 2, 0}));
  EXPECT_FALSE(agreesToVersion2({'x', 1, 0}));
  EXPECT_FALSE(agreesToVersion2({'x', 2, 1}));
}

TEST(FrameHeader, IsEightBytesBigEndian) {
  EXPECT_EQ(encoded(FrameHeader{'W', 85, 0x0102, 0x03040506}), hex("57 55 01 02 03 04 05 06"));

  const FrameHeader header = decodeFrameHeader(hex("66 ff fe 01 ff 00 00 02").data());
  EXPECT_EQ(header.kind, 'f');
  EXPECT_EQ(header.id, 255);
  EXPECT_EQ(header.request_number, 0xfe01);
  EXPECT_EQ(header.payload_size, 0xff000002U);
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

// `count` different parts of the body from id 0 on.
Bytes entriesOf(size_t count, const char* after_id) {
  Bytes bytes;
  for (size_t id = 0; id < count; ++id) {
    bytes = bytes + Bytes{static_cast<unsigned char>(id)} + hex(after_id);
  }
  return bytes;
}

constexpr char kJoint[] = "00 00 00 00 00 00 01";
constexpr char kLed[] = "ff 00 00";

TEST(Lists, TakeAsManyItemsAsThereIsRoomForAndNoMore) {
  EXPECT_THAT(verdict<JointTargets>(hex("00 00 20 00") + entriesOf(32, kJoint)), IsNull());
  EXPECT_THAT(verdict<JointTargets>(hex("00 00 21 00") + entriesOf(33, kJoint)), HasSubstr("more joints"));
  EXPECT_THAT(verdict<JointTargets>(hex("00 00 ff 00") + entriesOf(255, kJoint)), HasSubstr("more joints"));
  EXPECT_THAT(verdict<SpeedLimits>(entriesOf(32, kJoint)), IsNull());
  EXPECT_THAT(verdict<SpeedLimits>(entriesOf(33, kJoint)), HasSubstr("more joints"));
  EXPECT_THAT(verdict<SpeedLimits>(Bytes(MAX_PAYLOAD_TOWARDS_ROBOT, 0)), NotNull());
  EXPECT_THAT(verdict<LedValues>(entriesOf(32, kLed)), IsNull());
  EXPECT_THAT(verdict<LedValues>(entriesOf(33, kLed)), HasSubstr("more LEDs"));
  EXPECT_THAT(verdict<JointIds>(entriesOf(32, "")), IsNull());
  EXPECT_THAT(verdict<JointIds>(entriesOf(33, "")), HasSubstr("more joints"));
  EXPECT_THAT(verdict<JointIds>({}), HasSubstr("no joint"));
}

TEST(Lists, RefuseACountThatDoesNotFitTheSize) {
  for (const char* header : {"00 00 00 00", "00 00 01 00", "00 00 02 00", "00 00 04 00", "00 00 20 00"}) {
    EXPECT_THAT(verdict<JointTargets>(hex(header) + entriesOf(3, kJoint)), HasSubstr("count")) << header;
  }
}

TEST(Lists, RefuseWhatIsNamedTwice) {
  EXPECT_THAT(verdict<JointTargets>(hex("00 00 02 00") + entriesOf(1, kJoint) + entriesOf(1, kJoint)),
              HasSubstr("twice"));
  EXPECT_THAT(verdict<SpeedLimits>(entriesOf(2, kJoint) + entriesOf(1, kJoint)), HasSubstr("twice"));
  EXPECT_THAT(verdict<LedValues>(entriesOf(2, kLed) + entriesOf(1, kLed)), HasSubstr("twice"));
  EXPECT_THAT(verdict<JointIds>(hex("02 03 02")), HasSubstr("twice"));
}

// A push of `count` values that announces `announced` values.
Bytes telemetryOf(size_t count, unsigned announced) {
  Bytes bytes{0, 0, 0, 1, static_cast<unsigned char>(announced >> 8), static_cast<unsigned char>(announced), 0, 0};
  for (size_t i = 0; i < count; ++i) {
    bytes = bytes + hex("53 01 00 00 00 00 00 00");
  }
  return bytes;
}

TEST(Telemetry, TakesAsManyValuesAsThereIsRoomForAndNoMore) {
  EXPECT_THAT(verdict<Telemetry>(telemetryOf(0, 0)), IsNull());
  EXPECT_THAT(verdict<Telemetry>(telemetryOf(128, 128)), IsNull());
  EXPECT_THAT(verdict<Telemetry>(telemetryOf(129, 129)), HasSubstr("more values"));
  for (const unsigned announced : {0U, 1U, 3U, 128U}) {
    EXPECT_THAT(verdict<Telemetry>(telemetryOf(2, announced)), HasSubstr("count")) << announced;
  }
  for (const unsigned announced : {0x0102U, 0x0202U, 0xffffU}) {
    EXPECT_THAT(verdict<Telemetry>(telemetryOf(2, announced)), HasSubstr("more values")) << announced;
  }
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
