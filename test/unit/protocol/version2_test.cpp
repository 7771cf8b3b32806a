#include "protocol/version2.h"

#include <gmock/gmock.h>

#include <climits>
#include <numeric>
#include <string>

#include "layouts.h"

namespace protocol {
namespace version2 {
namespace {

using ::testing::HasSubstr;
using ::testing::IsNull;
using ::testing::NotNull;

JointTargets twoTargets() {
  JointTargets targets{};
  targets.duration_ms = 500;
  targets.count = 2;
  targets.joints[0] = {2, 500000};
  targets.joints[1] = {11, -1308997};
  return targets;
}

SpeedLimits twoLimits() {
  SpeedLimits limits{};
  limits.count = 2;
  limits.joints[0] = {1, 3185226};
  limits.joints[1] = {52, 15162548};
  return limits;
}

Telemetry threeValues() {
  Telemetry telemetry{};
  telemetry.frame_number = 0x80000001U;
  telemetry.count = 3;
  telemetry.entries[0] = {GROUP_JOINT, 3, -1};
  telemetry.entries[1] = {GROUP_SENSOR, 63, -9806650};
  telemetry.entries[2] = {GROUP_SENSOR, 14, 1};
  return telemetry;
}

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
  EXPECT_EQ(encoded(encodeFrameHeader, FrameHeader{'W', 85, 0x0102, 0x03040506}, FRAME_HEADER_SIZE),
            hex("57 55 01 02 03 04 05 06"));

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

TEST(PictureRequest, IsTheLayer) {
  EXPECT_EQ(encoded(encodePictureRequest, LAYER_DOUBLE, PICTURE_REQUEST_SIZE), hex("03"));

  Layer layer = LAYER_DOUBLE;
  ASSERT_THAT(decodePictureRequest(hex("01").data(), 1, &layer), IsNull());
  EXPECT_EQ(layer, LAYER_MIDDLE);
}

TEST(PictureRequest, TakesEveryLayerThatTheCameraHasAndNoOther) {
  EXPECT_THAT(verdict(decodePictureRequest)(hex("03")), IsNull());
  EXPECT_THAT(verdict(decodePictureRequest)(hex("04")), HasSubstr("layer"));
  EXPECT_THAT(verdict(decodePictureRequest)(hex("ff")), HasSubstr("layer"));
}

TEST(StreamSettings, HaveOnLayerAndEveryNthImage) {
  EXPECT_EQ(encoded(encodeStreamSettings, StreamSettings{true, LAYER_LOW, 0x0102}, STREAM_SETTINGS_SIZE),
            hex("01 02 01 02"));
  EXPECT_EQ(encoded(encodeStreamSettings, StreamSettings{false, LAYER_HIGH, 1}, STREAM_SETTINGS_SIZE),
            hex("00 00 00 01"));

  StreamSettings settings{};
  ASSERT_THAT(decodeStreamSettings(hex("01 03 ff fe").data(), 4, &settings), IsNull());
  EXPECT_TRUE(settings.on);
  EXPECT_EQ(settings.layer, LAYER_DOUBLE);
  EXPECT_EQ(settings.every_nth_image, 0xfffe);
  ASSERT_THAT(decodeStreamSettings(hex("00 00 00 01").data(), 4, &settings), IsNull());
  EXPECT_FALSE(settings.on);
}

TEST(StreamSettings, RefuseValuesWithoutAMeaning) {
  EXPECT_THAT(verdict(decodeStreamSettings)(hex("02 00 00 01")), HasSubstr("neither off (0) nor on (1)"));
  EXPECT_THAT(verdict(decodeStreamSettings)(hex("01 04 00 01")), HasSubstr("layer"));
  EXPECT_THAT(verdict(decodeStreamSettings)(hex("01 00 00 00")), HasSubstr("interval is 0"));
}

TEST(JointTargets, HaveADurationAndAPositionForEachJoint) {
  EXPECT_EQ(encoded(encodeJointTargets, twoTargets(), MAX_JOINT_TARGETS_SIZE), hex(kTwoTargets));

  const Bytes bytes = hex(kTwoTargets);
  JointTargets targets{};
  ASSERT_THAT(decodeJointTargets(bytes.data(), bytes.size(), &targets), IsNull());
  EXPECT_EQ(targets.duration_ms, 500);
  ASSERT_EQ(targets.count, 2);
  EXPECT_EQ(targets.joints[0].id, 2);
  EXPECT_EQ(targets.joints[0].value, 500000);
  EXPECT_EQ(targets.joints[1].id, 11);
  EXPECT_EQ(targets.joints[1].value, -1308997);
}

TEST(JointTargets, MayBeForNoJoint) {
  JointTargets targets = twoTargets();
  EXPECT_THAT(decodeJointTargets(hex("00 00 00 00").data(), 4, &targets), IsNull());
  EXPECT_EQ(targets.count, 0);
}

TEST(JointTargets, CarryTheOutermostValues) {
  JointTargets targets{};
  targets.duration_ms = USHRT_MAX;
  targets.count = 2;
  targets.joints[0] = {0, INT_MIN};
  targets.joints[1] = {255, INT_MAX};
  const Bytes bytes = encoded(encodeJointTargets, targets, MAX_JOINT_TARGETS_SIZE);
  EXPECT_EQ(bytes, hex("ff ff 02 00 00 00 00 00 80 00 00 00 ff 00 00 00 7f ff ff ff"));

  JointTargets again{};
  ASSERT_THAT(decodeJointTargets(bytes.data(), bytes.size(), &again), IsNull());
  EXPECT_EQ(again.joints[0].value, INT_MIN);
  EXPECT_EQ(again.joints[1].value, INT_MAX);
}

TEST(JointTargets, RefuseACountThatDoesNotFitTheSize) {
  const Bytes entries(MAX_JOINTS * 8, 0);
  for (const char* header : {"00 00 01 00", "00 00 1f 00", "00 00 21 00", "00 00 ff 00", "00 00 00 00"}) {
    EXPECT_THAT(verdict(decodeJointTargets)(hex(header) + entries), HasSubstr("count")) << header;
  }
}

// `count` different joints from id 0 on.
Bytes jointEntries(size_t count) {
  Bytes bytes;
  for (size_t id = 0; id < count; ++id) {
    bytes = bytes + Bytes{static_cast<unsigned char>(id), 0, 0, 0, 0, 0, 0, 1};
  }
  return bytes;
}

TEST(JointTargets, TakeAsManyJointsAsThereIsRoomForAndNoMore) {
  EXPECT_THAT(verdict(decodeJointTargets)(hex("00 00 20 00") + jointEntries(32)), IsNull());
  EXPECT_THAT(verdict(decodeJointTargets)(hex("00 00 21 00") + jointEntries(33)), HasSubstr("more joints"));
  EXPECT_THAT(verdict(decodeJointTargets)(hex("00 00 ff 00") + jointEntries(255)), HasSubstr("more joints"));
}

TEST(JointTargets, RefuseAJointNamedTwice) {
  Bytes bytes = hex(kTwoTargets);
  bytes[12] = bytes[4];
  EXPECT_THAT(verdict(decodeJointTargets)(bytes), HasSubstr("twice"));
}

TEST(SpeedLimits, HaveASpeedForEachJoint) {
  EXPECT_EQ(encoded(encodeSpeedLimits, twoLimits(), MAX_SPEED_LIMITS_SIZE), hex(kTwoLimits));

  const Bytes bytes = hex(kTwoLimits);
  SpeedLimits limits{};
  ASSERT_THAT(decodeSpeedLimits(bytes.data(), bytes.size(), &limits), IsNull());
  ASSERT_EQ(limits.count, 2);
  EXPECT_EQ(limits.joints[0].id, 1);
  EXPECT_EQ(limits.joints[0].value, 3185226);
  EXPECT_EQ(limits.joints[1].id, 52);
  EXPECT_EQ(limits.joints[1].value, 15162548);
}

TEST(SpeedLimits, AreReadByAnEmptyRequest) {
  EXPECT_EQ(encoded(encodeSpeedLimits, SpeedLimits{}, MAX_SPEED_LIMITS_SIZE), Bytes());
  SpeedLimits limits = twoLimits();
  ASSERT_THAT(decodeSpeedLimits(nullptr, 0, &limits), IsNull());
  EXPECT_EQ(limits.count, 0);
}

TEST(SpeedLimits, TakeAsManyJointsAsThereIsRoomForAndNoMore) {
  EXPECT_THAT(verdict(decodeSpeedLimits)(jointEntries(32)), IsNull());
  EXPECT_THAT(verdict(decodeSpeedLimits)(jointEntries(33)), HasSubstr("more joints"));
  EXPECT_THAT(verdict(decodeSpeedLimits)(Bytes(MAX_PAYLOAD_TOWARDS_ROBOT, 0)), HasSubstr("more joints"));
}

TEST(SpeedLimits, RefuseAJointNamedTwice) {
  Bytes bytes = hex(kTwoLimits);
  bytes[8] = bytes[0];
  EXPECT_THAT(verdict(decodeSpeedLimits)(bytes), HasSubstr("twice"));
}

TEST(TelemetryPeriod, IsANumberOfFrames) {
  EXPECT_EQ(encoded(encodeTelemetryPeriod, static_cast<unsigned short>(0x0102), TELEMETRY_PERIOD_SIZE), hex("01 02"));

  unsigned short frames = 0;
  ASSERT_THAT(decodeTelemetryPeriod(hex("00 04").data(), 2, &frames), IsNull());
  EXPECT_EQ(frames, 4);
}

TEST(MotorState, IsOnOrOff) {
  unsigned char payload[MOTOR_STATE_SIZE];
  for (const bool state : {true, false}) {
    EXPECT_EQ(encodeMotorState(state, payload), MOTOR_STATE_SIZE);
    EXPECT_EQ(payload[0], state ? 1 : 0);
    bool on = !state;
    EXPECT_THAT(decodeMotorState(payload, sizeof(payload), &on), IsNull());
    EXPECT_EQ(on, state);
  }
}

TEST(MotorState, RefusesOtherValues) {
  const unsigned char payload[] = {2};
  bool on = false;
  EXPECT_THAT(decodeMotorState(payload, sizeof(payload), &on), HasSubstr("motors"));
}

TEST(MotorsAndPosture, HaveFourBytes) {
  const MotorsAndPosture limp = {false, POSTURE_NOW_LYING};
  EXPECT_EQ(encoded(encodeMotorsAndPosture, limp, MOTORS_AND_POSTURE_SIZE), hex("00 03 0000"));
  const Bytes bytes = hex("01 04 0000");
  MotorsAndPosture state{};
  ASSERT_THAT(decodeMotorsAndPosture(bytes.data(), bytes.size(), &state), IsNull());
  EXPECT_TRUE(state.motors_on);
  EXPECT_EQ(state.posture, POSTURE_NOW_WALKING);
}

TEST(MotorsAndPosture, RefuseOtherLayouts) {
  MotorsAndPosture state{};
  for (const char* wrong : {"02 01 0000", "01 01 0001", "01 01 00", "01 01 0000 00"}) {
    const Bytes bytes = hex(wrong);
    EXPECT_THAT(decodeMotorsAndPosture(bytes.data(), bytes.size(), &state), NotNull()) << wrong;
  }
  const Bytes newer = hex("01 4d 0000");
  EXPECT_THAT(decodeMotorsAndPosture(newer.data(), newer.size(), &state), IsNull()) << "a newer server's posture";
}

TEST(Telemetry, HasAFrameNumberAndTheMeasuredValues) {
  EXPECT_EQ(encoded(encodeTelemetry, threeValues(), MAX_TELEMETRY_SIZE), hex(kThreeValues));

  const Bytes bytes = hex(kThreeValues);
  Telemetry telemetry{};
  ASSERT_THAT(decodeTelemetry(bytes.data(), bytes.size(), &telemetry), IsNull());
  EXPECT_EQ(telemetry.frame_number, 0x80000001U);
  ASSERT_EQ(telemetry.count, 3);
  EXPECT_EQ(telemetry.entries[0].group, GROUP_JOINT);
  EXPECT_EQ(telemetry.entries[0].id, 3);
  EXPECT_EQ(telemetry.entries[0].value, -1);
  EXPECT_EQ(telemetry.entries[1].group, GROUP_SENSOR);
  EXPECT_EQ(telemetry.entries[1].id, 63);
  EXPECT_EQ(telemetry.entries[1].value, -9806650);
  EXPECT_EQ(telemetry.entries[2].id, 14);
  EXPECT_EQ(telemetry.entries[2].value, 1);
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
  EXPECT_THAT(verdict(decodeTelemetry)(telemetryOf(0, 0)), IsNull());
  EXPECT_THAT(verdict(decodeTelemetry)(telemetryOf(128, 128)), IsNull());
  EXPECT_THAT(verdict(decodeTelemetry)(telemetryOf(129, 129)), HasSubstr("more values"));
}

TEST(Telemetry, RefusesACountThatDoesNotFitTheSize) {
  for (const unsigned announced : {0U, 1U, 3U, 0x0102U, 0x0202U, 0xffffU}) {
    EXPECT_THAT(verdict(decodeTelemetry)(telemetryOf(2, announced)), HasSubstr("count")) << announced;
  }
}

TEST(Telemetry, RefusesAnUnknownGroup) {
  Bytes bytes = hex(kThreeValues);
  bytes[16] = 'L';
  EXPECT_THAT(verdict(decodeTelemetry)(bytes), HasSubstr("not one of J, S, D and W"));
}

TEST(Telemetry, MayHaveDutiesAndTheWalk) {
  for (const char group : {GROUP_DUTY, GROUP_WALK}) {
    Bytes bytes = hex(kThreeValues);
    bytes[16] = static_cast<unsigned char>(group);
    EXPECT_THAT(verdict(decodeTelemetry)(bytes), IsNull()) << group;
  }
}

TEST(LedValues, HaveIntensityAndModeForEachLed) {
  LedValues values{};
  values.count = 2;
  values.leds[0] = {2, 255, LED_MODE_A};
  values.leds[1] = {26, 128, LED_MODE_B};
  EXPECT_EQ(encoded(encodeLedValues, values, MAX_LED_VALUES_SIZE), hex(kTwoLeds));

  LedValues again{};
  ASSERT_THAT(decodeLedValues(hex(kTwoLeds).data(), 8, &again), IsNull());
  ASSERT_EQ(again.count, 2);
  EXPECT_EQ(again.leds[0].id, 2);
  EXPECT_EQ(again.leds[0].intensity, 255);
  EXPECT_EQ(again.leds[0].mode, LED_MODE_A);
  EXPECT_EQ(again.leds[1].id, 26);
  EXPECT_EQ(again.leds[1].intensity, 128);
  EXPECT_EQ(again.leds[1].mode, LED_MODE_B);
}

TEST(LedValues, MayBeForNoLed) {
  LedValues values{};
  values.count = 7;
  ASSERT_THAT(decodeLedValues(nullptr, 0, &values), IsNull());
  EXPECT_EQ(values.count, 0);
}

TEST(LedValues, RefuseAnUnknownMode) {
  EXPECT_THAT(verdict(decodeLedValues)(hex("01 ff 02 00")), HasSubstr("mode"));
  EXPECT_THAT(verdict(decodeLedValues)(hex("01 ff ff 00")), HasSubstr("mode"));
}

TEST(LedValues, RefuseAnLedNamedTwice) {
  EXPECT_THAT(verdict(decodeLedValues)(hex("01 ff 00 00 02 ff 00 00 01 00 00 00")), HasSubstr("twice"));
}

// `count` different LEDs from id 0 on.
Bytes ledEntries(size_t count) {
  Bytes bytes;
  for (size_t id = 0; id < count; ++id) {
    bytes = bytes + Bytes{static_cast<unsigned char>(id), 255, 0, 0};
  }
  return bytes;
}

TEST(LedValues, TakeAsManyLedsAsThereIsRoomForAndNoMore) {
  EXPECT_THAT(verdict(decodeLedValues)(ledEntries(32)), IsNull());
  EXPECT_THAT(verdict(decodeLedValues)(ledEntries(33)), HasSubstr("more LEDs"));
  EXPECT_THAT(verdict(decodeLedValues)(Bytes(MAX_PAYLOAD_TOWARDS_ROBOT, 0)), HasSubstr("more LEDs"));
}

TEST(EarPositions, AreLeftThenRight) {
  EXPECT_EQ(encoded(encodeEarPositions, EarPositions{true, false}, EAR_POSITIONS_SIZE), hex("01 00"));

  EarPositions positions{true, false};
  ASSERT_THAT(decodeEarPositions(hex("00 01").data(), 2, &positions), IsNull());
  EXPECT_FALSE(positions.left);
  EXPECT_TRUE(positions.right);
}

TEST(EarPositions, RefuseOtherValues) {
  EXPECT_THAT(verdict(decodeEarPositions)(hex("02 00")), HasSubstr("ear"));
  EXPECT_THAT(verdict(decodeEarPositions)(hex("00 ff")), HasSubstr("ear"));
}

TEST(NoPayload, IsRefusedUnlessItIsEmpty) {
  EXPECT_THAT(checkNoPayload(0), IsNull());
  EXPECT_THAT(checkNoPayload(1), NotNull());
  EXPECT_THAT(checkNoPayload(MAX_PAYLOAD_TOWARDS_ROBOT), NotNull());
}

TEST(Picture, HasItsHeaderBeforeTheJpeg) {
  const ImageHeader written{0x00010203, 0x0a0b0c0d, 208, 160, 85, LAYER_HIGH, {}};
  EXPECT_EQ(encoded(encodeImageHeader, written, IMAGE_HEADER_SIZE), firstOf(hex(kPicture), IMAGE_HEADER_SIZE));

  const Bytes bytes = hex(kPicture);
  ImageHeader header{};
  size_t jpeg_size = 0;
  ASSERT_THAT(decodePicture(bytes.data(), bytes.size(), &header, &jpeg_size), IsNull());
  EXPECT_EQ(header.image_count, 0x00010203U);
  EXPECT_EQ(header.frame_number, 0x0a0b0c0dU);
  EXPECT_EQ(header.width, 208);
  EXPECT_EQ(header.height, 160);
  EXPECT_EQ(header.quality, 85);
  EXPECT_EQ(header.layer, LAYER_HIGH);
  EXPECT_EQ(jpeg_size, 4U);
}

TEST(Picture, MayBeAsLargeAsAFrameAllows) {
  Bytes bytes = hex(kPicture);
  bytes.resize(MAX_PAYLOAD_TOWARDS_CLIENT);
  ImageHeader header{};
  size_t jpeg_size = 0;
  ASSERT_THAT(decodePicture(bytes.data(), bytes.size(), &header, &jpeg_size), IsNull());
  EXPECT_EQ(jpeg_size, MAX_JPEG_SIZE);
}

TEST(Picture, RefusesAnImpossibleHeader) {
  const auto with = [](size_t offset, unsigned char value) {
    Bytes bytes = hex(kPicture);
    bytes[offset] = value;
    return bytes;
  };
  EXPECT_THAT(decodePictureBytes(with(9, 0)), HasSubstr("no width"));
  EXPECT_THAT(decodePictureBytes(with(11, 0)), HasSubstr("no height"));
  EXPECT_THAT(decodePictureBytes(with(12, 100)), IsNull());
  EXPECT_THAT(decodePictureBytes(with(12, 101)), HasSubstr("quality"));
  EXPECT_THAT(decodePictureBytes(with(13, 3)), IsNull());
  EXPECT_THAT(decodePictureBytes(with(13, 4)), HasSubstr("layer"));
  EXPECT_THAT(decodePictureBytes(with(14, 1)), HasSubstr("camera setting"));
  EXPECT_THAT(decodePictureBytes(firstOf(hex(kPicture), IMAGE_HEADER_SIZE)), HasSubstr("no picture"));
}

TEST(Picture, MayHaveTheCamerasSettings) {
  ImageHeader header{0, 0, 416, 320, 85, LAYER_DOUBLE, {{3, 2, 1, 0, 1}}};
  Bytes bytes = encoded(encodeImageHeader, header, IMAGE_HEADER_SIZE);
  EXPECT_EQ(bytes[15], 0x9b);
  bytes.push_back(0xff);
  size_t jpeg_size = 0;
  header.settings = CameraSettings();
  ASSERT_THAT(decodePicture(bytes.data(), bytes.size(), &header, &jpeg_size), IsNull());
  EXPECT_EQ(header.settings.of(SETTING_WHITE_BALANCE), 3);
  EXPECT_EQ(header.settings.of(SETTING_SHUTTER_SPEED), 1);
  EXPECT_EQ(header.settings.of(SETTING_AUTO_WHITE_BALANCE), 1);
}

std::string textOf(const ErrorMessage& message) {
  return std::string(message.text, message.text_size);
}

TEST(ErrorMessage, HasACodeAndAText) {
  const std::string text = "no joint 99; \xc3\xa9t\xc3\xa9";
  const Bytes bytes =
      encoded(encodeErrorMessage, ErrorMessage{CODE_NOT_SUPPORTED, text.data(), text.size()}, MAX_ERROR_MESSAGE_SIZE);
  EXPECT_EQ(bytes, hex("00 02") + bytesOf(text));

  ErrorMessage message{};
  ASSERT_THAT(decodeErrorMessage(bytes.data(), bytes.size(), &message), IsNull());
  EXPECT_EQ(message.code, CODE_NOT_SUPPORTED);
  EXPECT_EQ(textOf(message), text);
}

TEST(ErrorMessage, MayHaveACodeOfANewerServerAndNoText) {
  ErrorMessage message{};
  ASSERT_THAT(decodeErrorMessage(hex("ff fe").data(), 2, &message), IsNull());
  EXPECT_EQ(message.code, 0xfffe);
  EXPECT_EQ(textOf(message), "");
}

TEST(ErrorMessage, IsCutAfterAWholeCharacter) {
  std::string text(MAX_ERROR_TEXT_SIZE - 1, 'a');
  const Bytes bytes =
      encoded(encodeErrorMessage, ErrorMessage{0, (text + "\xc3\xa9").data(), text.size() + 2}, MAX_ERROR_MESSAGE_SIZE);
  EXPECT_EQ(bytes, hex("00 00") + bytesOf(text));
}

TEST(ErrorMessage, RefusesATextThatWouldSpoilALog) {
  EXPECT_THAT(verdict(decodeErrorMessage)(hex("00 00 1b 5b 32 4a")), HasSubstr("control"));
  EXPECT_THAT(verdict(decodeErrorMessage)(hex("00 00 ff fe")), HasSubstr("UTF-8"));
}

EndMessage endOf(const std::string& name, const std::string& reason) {
  return {ENDED_MOTION, END_REPLACED, name.data(), name.size(), reason.data(), reason.size()};
}

TEST(EndMessage, HasWhatHowNameAndReason) {
  const std::string name = "NOD.MTN";
  const std::string reason = "c\xc3\xa9";
  const Bytes bytes = encoded(encodeEndMessage, endOf(name, reason), MAX_END_MESSAGE_SIZE);
  EXPECT_EQ(bytes, hex(kEnd));

  EndMessage message{};
  ASSERT_THAT(decodeEndMessage(bytes.data(), bytes.size(), &message), IsNull());
  EXPECT_EQ(message.what, ENDED_MOTION);
  EXPECT_EQ(message.how, END_REPLACED);
  EXPECT_EQ(std::string(message.name, message.name_size), name);
  EXPECT_EQ(std::string(message.reason, message.reason_size), reason);
}

TEST(EndMessage, MayBeOfANewerServerAndHaveNeitherNameNorReason) {
  EndMessage message{};
  ASSERT_THAT(decodeEndMessage(hex("c8 c9 00 00 0a").data(), 5, &message), IsNull());
  EXPECT_EQ(message.what, 200);
  EXPECT_EQ(message.how, 201);
  EXPECT_EQ(message.name_size, 0U);
  EXPECT_EQ(message.reason_size, 0U);
}

TEST(EndMessage, IsCutAfterAWholeCharacter) {
  const std::string name(MAX_END_NAME_SIZE - 1, 'n');
  const std::string reason(MAX_END_REASON_SIZE - 1, 'r');
  const std::string long_name = name + "\xc3\xa9";
  const std::string long_reason = reason + "\xc3\xa9";
  EXPECT_EQ(encoded(encodeEndMessage, endOf(long_name, long_reason), MAX_END_MESSAGE_SIZE),
            hex("01 01 00 00") + bytesOf(name + "\n" + reason));
}

TEST(EndMessage, RefusesATextThatWouldSpoilALog) {
  EXPECT_THAT(verdict(decodeEndMessage)(hex("01 00 00 00 1b 0a")), HasSubstr("control"));
  EXPECT_THAT(verdict(decodeEndMessage)(hex("01 00 00 00 0a ff")), HasSubstr("UTF-8"));
  EXPECT_THAT(verdict(decodeEndMessage)(hex("01 00 00 00 0a 41 0a 42")), HasSubstr("control"));
  EXPECT_THAT(verdict(decodeEndMessage)(hex("01 00 00 00 41")), HasSubstr("newline"));
}

TEST(JointIds, AreOneByteEach) {
  JointIds joints{};
  joints.count = 2;
  joints.ids[0] = 2;
  joints.ids[1] = 52;
  EXPECT_EQ(encoded(encodeJointIds, joints, MAX_JOINT_IDS_SIZE), hex(kTwoIds));

  JointIds again{};
  ASSERT_THAT(decodeJointIds(hex(kTwoIds).data(), 2, &again), IsNull());
  ASSERT_EQ(again.count, 2);
  EXPECT_EQ(again.ids[0], 2);
  EXPECT_EQ(again.ids[1], 52);
}

TEST(JointIds, AreAtLeastOneAtMostAsManyAsThereIsRoomForAndEachOnce) {
  Bytes ids(MAX_JOINTS);
  std::iota(ids.begin(), ids.end(), static_cast<unsigned char>(1));
  EXPECT_THAT(verdict(decodeJointIds)(ids), IsNull());
  EXPECT_THAT(verdict(decodeJointIds)(ids + Bytes{77}), HasSubstr("more joints"));
  EXPECT_THAT(verdict(decodeJointIds)(hex("02 03 02")), HasSubstr("twice"));
  EXPECT_THAT(verdict(decodeJointIds)({}), HasSubstr("no joint"));
}

TEST(Version2, LeavesTheResultUnchangedWhenItRefuses) {
  Bytes bytes = hex(kTwoTargets);
  bytes.pop_back();
  JointTargets targets = twoTargets();
  targets.duration_ms = 7;
  ASSERT_THAT(decodeJointTargets(bytes.data(), bytes.size(), &targets), NotNull());
  EXPECT_EQ(targets.duration_ms, 7);
  EXPECT_EQ(targets.count, 2);
}

}  // namespace
}  // namespace version2
}  // namespace protocol
