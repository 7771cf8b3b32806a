#include "protocol/version2.h"

#include <gmock/gmock.h>

#include <climits>
#include <string>

#include "layouts.h"

namespace protocol {
namespace version2 {
namespace {

using ::testing::HasSubstr;
using ::testing::IsNull;
using ::testing::NotNull;

TEST(Version2, IsAskedForInVersion1) {
  unsigned char request[BASIC_COMMAND_SIZE];
  encodeCommand(versionRequest(), request);
  EXPECT_THAT(request, ::testing::ElementsAre('X', 2));

  unsigned char reply[VALUE_REPLY_SIZE];
  encodeValueReply(versionReply(), reply);
  EXPECT_THAT(reply, ::testing::ElementsAre('x', 2, 0, 0));
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

  const FrameHeader header = decodeFrameHeader(hex("66 ff fe 01 ff 00 00 02").data());
  EXPECT_EQ(header.kind, 'f');
  EXPECT_EQ(header.id, 255);
  EXPECT_EQ(header.request_number, 0xfe01);
  EXPECT_EQ(header.payload_size, 0xff000002U);
}

TEST(FrameHeader, NamesTheReplyAfterTheRequest) {
  EXPECT_EQ(replyKind(REQUEST_PICTURE), PICTURE);
  EXPECT_EQ(replyKind(REQUEST_TELEMETRY), TELEMETRY_PUSH);
  EXPECT_EQ(replyKind(REQUEST_HELLO), 'h');
  EXPECT_EQ(replyKind('Z'), 'z');
}

TEST(FrameHeader, OfAReplyToAPostureIsNoError) {
  EXPECT_EQ(replyKind(REQUEST_POSTURE), ERROR_MESSAGE);
  EXPECT_FALSE(isError('e', 0));
  EXPECT_TRUE(isError('e', 1));  // too short, but that is for its decoder to say
  EXPECT_TRUE(isError('e', 2));
  EXPECT_FALSE(isError('s', 8));
}

TEST(PictureRequest, TakesEveryLayerThatTheCameraHasAndNoOther) {
  EXPECT_EQ(decoded<PictureRequest>(hex("01")).layer, LAYER_MIDDLE);
  EXPECT_EQ(decoded<PictureRequest>(hex("03")).layer, LAYER_DOUBLE);
  EXPECT_THAT(verdict<PictureRequest>(hex("04")), HasSubstr("layer"));
  EXPECT_THAT(verdict<PictureRequest>(hex("ff")), HasSubstr("layer"));
}

TEST(StreamSettings, HaveOnLayerAndEveryNthImage) {
  const auto settings = decoded<StreamSettings>(hex("01 03 ff fe"));
  EXPECT_TRUE(settings.on);
  EXPECT_EQ(settings.layer, LAYER_DOUBLE);
  EXPECT_EQ(settings.every_nth_image, 0xfffe);
  EXPECT_FALSE(decoded<StreamSettings>(hex("00 00 00 01")).on);
  EXPECT_THAT(verdict<StreamSettings>(hex("02 00 00 01")), HasSubstr("neither off (0) nor on (1)"));
  EXPECT_THAT(verdict<StreamSettings>(hex("01 04 00 01")), HasSubstr("layer"));
  EXPECT_THAT(verdict<StreamSettings>(hex("01 00 00 00")), HasSubstr("interval is 0"));
}

TEST(JointTargets, HaveADurationAndAPositionForEachJoint) {
  const auto targets = decoded<JointTargets>(hex(kTwoTargets));
  EXPECT_EQ(targets.duration_ms, 500);
  ASSERT_EQ(targets.count, 2);
  EXPECT_EQ(targets.joints[0].id, 2);
  EXPECT_EQ(targets.joints[0].value, 500000);
  EXPECT_EQ(targets.joints[1].id, 11);
  EXPECT_EQ(targets.joints[1].value, -1308997);
  EXPECT_EQ(decoded<JointTargets>(hex("00 00 00 00")).count, 0);
}

TEST(JointTargets, CarryTheOutermostValues) {
  const Bytes bytes = hex("ff ff 02 00 00 00 00 00 80 00 00 00 ff 00 00 00 7f ff ff ff");
  const auto targets = decoded<JointTargets>(bytes);
  EXPECT_EQ(targets.duration_ms, USHRT_MAX);
  EXPECT_EQ(targets.joints[0].value, INT_MIN);
  EXPECT_EQ(targets.joints[1].id, 255);
  EXPECT_EQ(targets.joints[1].value, INT_MAX);
  EXPECT_EQ(encoded(targets), bytes);
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

TEST(SpeedLimits, HaveASpeedForEachJoint) {
  const auto limits = decoded<SpeedLimits>(hex(kTwoLimits));
  ASSERT_EQ(limits.count, 2);
  EXPECT_EQ(limits.joints[0].id, 1);
  EXPECT_EQ(limits.joints[0].value, 3185226);
  EXPECT_EQ(limits.joints[1].id, 52);
  EXPECT_EQ(limits.joints[1].value, 15162548);
  EXPECT_EQ(decoded<SpeedLimits>({}).count, 0) << "reads all limits";
}

TEST(MotorState, IsOnOrOff) {
  EXPECT_TRUE(decoded<MotorState>(hex("01")).on);
  EXPECT_FALSE(decoded<MotorState>(hex("00")).on);
  EXPECT_THAT(verdict<MotorState>(hex("02")), HasSubstr("motors"));
}

TEST(MotorsAndPosture, MayHaveAPostureOfANewerServer) {
  const auto state = decoded<MotorsAndPosture>(hex("01 4d 00 00"));
  EXPECT_TRUE(state.motors_on);
  EXPECT_EQ(state.posture, 0x4d);
  EXPECT_THAT(verdict<MotorsAndPosture>(hex("02 01 00 00")), HasSubstr("motors"));
}

TEST(Telemetry, HasAFrameNumberAndTheMeasuredValues) {
  const auto telemetry = decoded<Telemetry>(hex(kThreeValues));
  EXPECT_EQ(telemetry.frame_number, 0x80000001U);
  ASSERT_EQ(telemetry.count, 3);
  EXPECT_EQ(telemetry.entries[0].group, GROUP_JOINT);
  EXPECT_EQ(telemetry.entries[0].id, 3);
  EXPECT_EQ(telemetry.entries[0].value, -1);
  EXPECT_EQ(telemetry.entries[1].group, GROUP_SENSOR);
  EXPECT_EQ(telemetry.entries[1].value, -9806650);
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

TEST(Telemetry, HasFourGroups) {
  Bytes bytes = hex(kThreeValues);
  for (const char group : {GROUP_JOINT, GROUP_SENSOR, GROUP_DUTY, GROUP_WALK}) {
    bytes[16] = static_cast<unsigned char>(group);
    EXPECT_THAT(verdict<Telemetry>(bytes), IsNull()) << group;
  }
  bytes[16] = 'L';
  EXPECT_THAT(verdict<Telemetry>(bytes), HasSubstr("not one of J, S, D and W"));
}

TEST(LedValues, HaveIntensityAndModeForEachLed) {
  const auto values = decoded<LedValues>(hex(kTwoLeds));
  ASSERT_EQ(values.count, 2);
  EXPECT_EQ(values.leds[0].id, 2);
  EXPECT_EQ(values.leds[0].intensity, 255);
  EXPECT_EQ(values.leds[0].mode, LED_MODE_A);
  EXPECT_EQ(values.leds[1].mode, LED_MODE_B);
  EXPECT_EQ(decoded<LedValues>({}).count, 0);
  EXPECT_THAT(verdict<LedValues>(hex("01 ff 02 00")), HasSubstr("mode"));
  EXPECT_THAT(verdict<LedValues>(hex("01 ff ff 00")), HasSubstr("mode"));
}

TEST(EarPositions, AreLeftThenRight) {
  const auto positions = decoded<EarPositions>(hex("00 01"));
  EXPECT_FALSE(positions.left);
  EXPECT_TRUE(positions.right);
  EXPECT_THAT(verdict<EarPositions>(hex("02 00")), HasSubstr("ear"));
  EXPECT_THAT(verdict<EarPositions>(hex("00 ff")), HasSubstr("ear"));
}

TEST(NoPayload, IsRefusedUnlessItIsEmpty) {
  EXPECT_THAT(verdict<NoPayload>({}), IsNull());
  EXPECT_THAT(verdict<NoPayload>(hex("00")), HasSubstr("size"));
}

TEST(Picture, HasItsHeaderBeforeTheJpeg) {
  const Bytes bytes = hex(kPicture);
  const auto picture = decoded<PicturePayload>(bytes);
  EXPECT_EQ(picture.header.image_count, 0x00010203U);
  EXPECT_EQ(picture.header.frame_number, 0x0a0b0c0dU);
  EXPECT_EQ(picture.header.width, 208);
  EXPECT_EQ(picture.header.height, 160);
  EXPECT_EQ(picture.header.quality, 85);
  EXPECT_EQ(picture.header.layer, LAYER_HIGH);
  EXPECT_EQ(picture.jpeg, bytes.data() + IMAGE_HEADER_SIZE);
  EXPECT_EQ(picture.jpeg_size, 4U);
  EXPECT_EQ(encodedSize(picture.header), IMAGE_HEADER_SIZE);
}

TEST(Picture, RefusesAnImpossibleHeader) {
  const auto with = [](size_t offset, unsigned char value) {
    Bytes bytes = hex(kPicture);
    bytes[offset] = value;
    return verdict<PicturePayload>(bytes);
  };
  EXPECT_THAT(with(9, 0), HasSubstr("no width"));
  EXPECT_THAT(with(11, 0), HasSubstr("no height"));
  EXPECT_THAT(with(12, 100), IsNull());
  EXPECT_THAT(with(12, 101), HasSubstr("quality"));
  EXPECT_THAT(with(13, 3), IsNull());
  EXPECT_THAT(with(13, 4), HasSubstr("layer"));
  EXPECT_THAT(with(14, 1), HasSubstr("camera setting"));
  EXPECT_THAT(verdict<PicturePayload>(firstOf(hex(kPicture), IMAGE_HEADER_SIZE)), HasSubstr("no picture"));
}

TEST(Picture, MayHaveTheCamerasSettings) {
  const Bytes bytes = encoded(ImageHeader{0, 0, 416, 320, 85, LAYER_DOUBLE, {{3, 2, 1, 0, 1}}});
  EXPECT_EQ(bytes[15], 0x9b);
  const auto header = decoded<ImageHeader>(bytes);
  EXPECT_EQ(header.settings.of(SETTING_WHITE_BALANCE), 3);
  EXPECT_EQ(header.settings.of(SETTING_SHUTTER_SPEED), 1);
  EXPECT_EQ(header.settings.of(SETTING_AUTO_WHITE_BALANCE), 1);
}

TEST(ErrorMessage, HasACodeAndAText) {
  const Bytes bytes = hex("00 02") + bytesOf("no joint 99; \xc3\xa9t\xc3\xa9");
  const auto message = decoded<ErrorMessage>(bytes);
  EXPECT_EQ(message.code, CODE_NOT_SUPPORTED);
  EXPECT_EQ(std::string(message.text, message.text_size), "no joint 99; \xc3\xa9t\xc3\xa9");
  EXPECT_EQ(decoded<ErrorMessage>(hex("ff fe")).code, 0xfffe) << "of a newer server";
}

TEST(Texts, AreCutAfterAWholeCharacter) {
  const std::string text(MAX_ERROR_TEXT_SIZE - 1, 'a');
  const std::string longer = text + "\xc3\xa9";
  EXPECT_EQ(encoded(ErrorMessage{0, longer.data(), longer.size()}), hex("00 00") + bytesOf(text));

  const std::string name(MAX_END_NAME_SIZE - 1, 'n');
  const std::string long_name = name + "\xc3\xa9";
  EXPECT_EQ(
      encoded(EndMessage{ENDED_MOTION, END_REPLACED, long_name.data(), long_name.size(), longer.data(), longer.size()}),
      hex("01 01 00 00") + bytesOf(name + "\n" + text));
}

TEST(Texts, AreRefusedIfTheyWouldSpoilALog) {
  EXPECT_THAT(verdict<ErrorMessage>(hex("00 00 1b 5b 32 4a")), HasSubstr("control"));
  EXPECT_THAT(verdict<ErrorMessage>(hex("00 00 ff fe")), HasSubstr("UTF-8"));
  EXPECT_THAT(verdict<EndMessage>(hex("01 00 00 00 1b 0a")), HasSubstr("control"));
  EXPECT_THAT(verdict<EndMessage>(hex("01 00 00 00 0a ff")), HasSubstr("UTF-8"));
  EXPECT_THAT(verdict<EndMessage>(hex("01 00 00 00 0a 41 0a 42")), HasSubstr("control"));
  EXPECT_THAT(verdict<EndMessage>(hex("01 00 00 00 41")), HasSubstr("newline"));
}

TEST(EndMessage, HasWhatHowNameAndReason) {
  const Bytes bytes = hex(kEnd);
  const auto message = decoded<EndMessage>(bytes);
  EXPECT_EQ(message.what, ENDED_MOTION);
  EXPECT_EQ(message.how, END_REPLACED);
  EXPECT_EQ(std::string(message.name, message.name_size), "NOD.MTN");
  EXPECT_EQ(std::string(message.reason, message.reason_size), "c\xc3\xa9");
}

TEST(EndMessage, MayBeOfANewerServerAndHaveNeitherNameNorReason) {
  const auto message = decoded<EndMessage>(hex("c8 c9 00 00 0a"));
  EXPECT_EQ(message.what, 200);
  EXPECT_EQ(message.how, 201);
  EXPECT_EQ(message.name_size, 0U);
  EXPECT_EQ(message.reason_size, 0U);
}

}  // namespace
}  // namespace version2
}  // namespace protocol
