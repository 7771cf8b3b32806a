#include <gmock/gmock.h>

#include <algorithm>
#include <climits>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "layouts.h"
#include "protocol/camera_settings.h"
#include "protocol/motion_requests.h"
#include "protocol/picture_datagram.h"
#include "protocol/sound_requests.h"
#include "protocol/stick_pictures.h"
#include "protocol/walk_requests.h"

namespace protocol {
namespace version2 {
namespace {

using ::testing::HasSubstr;
using ::testing::IsNull;
using ::testing::NotNull;

struct Layout {
  const char* name;
  Bytes payload;
  std::function<Bytes()> encode;  // the value that the payload stands for
  std::function<const char*(const Bytes&)> decode;
  // Decodes an accepted payload and encodes the result.
  std::function<Bytes(const Bytes&)> encode_again;
  // Offsets of bytes that must be 0.
  std::vector<size_t> reserved;
  // Smaller sizes at which the beginning of the payload is complete, too.
  std::vector<size_t> whole_at;
  // True if the last field takes all remaining bytes of the frame.
  bool takes_more;
};

template <typename Payload>
Layout layout(const char* name, const Payload& value, const Bytes& payload, const std::vector<size_t>& reserved = {},
              const std::vector<size_t>& whole_at = {}, bool takes_more = false) {
  return {name,
          payload,
          [value] { return encoded(value); },
          verdict<Payload>,
          [](const Bytes& bytes) { return encoded(decoded<Payload>(bytes)); },
          reserved,
          whole_at,
          takes_more};
}

Layout listLayout(const char* name, const FileList& value, const Bytes& payload, ReadFileName read,
                  const std::vector<size_t>& whole_at) {
  const auto encode = [](const FileList& list) {
    Bytes bytes(MAX_FILE_LIST_SIZE);
    return firstOf(bytes, encodeFileList(list, bytes.data()));
  };
  const auto verdict_on = [read](const Bytes& bytes) {
    FileList list{};
    return decodeFileList(read, bytes.data(), bytes.size(), &list);
  };
  const auto encode_again = [read, encode](const Bytes& bytes) {
    FileList list{};
    decodeFileList(read, bytes.data(), bytes.size(), &list);
    return encode(list);
  };
  return {name, payload, [=] { return encode(value); }, verdict_on, encode_again, {}, whole_at, false};
}

const unsigned char kBytes[] = {'O',  'M',  'T',  'N',  0x00, 0x01, 0xff, 0xff,
                                0x7f, 0xff, 0x80, 0x00, 0xff, 0xd8, 0xff, 0xd9};
const unsigned char* const kMotion = kBytes;
const unsigned char* const kSamples = kBytes + 4;
const unsigned char* const kJpeg = kBytes + 12;

ColorTable colorTable() {
  ColorTable table{6, {}};
  table.segments[0] = {1, 2, 3, 4};
  table.segments[31] = {150, 230, 120, 190};
  return table;
}

const ColorRegion kNothing = {6, 0, 0, 0, 0, 0, 0, 0};

const Layout kLayouts[] = {
    layout("PictureRequest", PictureRequest{LAYER_MIDDLE}, hex("01")),
    layout("StreamSettings", StreamSettings{true, LAYER_DOUBLE, 0xfffe}, hex("01 03 ff fe")),
    layout("JointTargets", JointTargets{500, 2, {{2, 500000}, {11, -1308997}}}, hex(kTwoTargets),
           {3, 5, 6, 7, 13, 14, 15}),
    layout("OutermostTargets", JointTargets{USHRT_MAX, 2, {{0, INT_MIN}, {255, INT_MAX}}},
           hex("ff ff 02 00 00 00 00 00 80 00 00 00 ff 00 00 00 7f ff ff ff")),
    layout("JointOrder", JointOrder{168496141, {500, 2, {{2, 500000}, {11, -1308997}}}},
           hex("0a 0b 0c 0d") + hex(kTwoTargets), {7, 9, 10, 11, 17, 18, 19}),
    layout("SpeedLimits", SpeedLimits{2, {{1, 3185226}, {52, 15162548}}}, hex(kTwoLimits), {1, 2, 3, 9, 10, 11},
           {0, 8}),
    layout("TelemetryPeriod", TelemetryPeriod{4}, hex("00 04")),
    layout("JointIds", JointIds{2, {2, 0x34}}, hex(kTwoIds), {}, {1}, true),
    layout("Telemetry",
           Telemetry{0x80000001, 3, {{GROUP_JOINT, 3, -1}, {GROUP_SENSOR, 63, -9806650}, {GROUP_SENSOR, 14, 1}}},
           hex(kThreeValues), {6, 7, 10, 11, 18, 19, 26, 27}),
    layout("MotorOrder", MotorOrder{NEVER_TOO_OLD, true}, hex("ff ff ff ff 01")),
    layout("MotorState", MotorState{true}, hex("01")),
    layout("MotorsAndPosture", MotorsAndPosture{true, POSTURE_WALK}, hex("01 04 00 00"), {2, 3}),
    layout("LedValues", LedValues{2, {{2, 255, LED_MODE_A}, {26, 128, LED_MODE_B}}}, hex(kTwoLeds), {3, 7}, {0, 4}),
    layout("EarPositions", EarPositions{true, false}, hex("01 00")),
    layout("ColorSettings", ColorSettings{2, true}, hex("00 02 01 00"), {3}),
    layout("ColorTable", colorTable(),
           hex("06 00 00 00 01 02 03 04") + Bytes(4 * (COLOR_SEGMENTS - 2), 0) + hex("96 e6 78 be"), {1, 2, 3}),
    layout("ColorRegions",
           ColorRegions{66051, 168496141, 104, 80, 2, false, {{0, 300, 3328, 2560, 42, 30, 20, 21}, kNothing}, NULL, 0},
           hex(kColorRegions), {14, 15, 17, 18, 19, 37, 38, 39}),
    layout("MicrophoneSettings", MicrophoneSettings{MICROPHONE_ON | SOUND_FIRST, 2, 16000}, hex("03 02 3e 80")),
    layout("HeardSound", HeardSound{168496141, 2, 2, kSamples, 8}, hex(kHeardSound), {7}),
    layout("PlayedSound", PlayedSound{16000, true, kSamples, 4}, hex(kPlayedSound), {5, 6, 7}, {8, 10}),
    layout("SpeakerRoom", SpeakerRoom{15360}, hex("00 00 3c 00")),
    layout("SoundEnd", SoundEnd{END_REFUSED, 16000, 1, 64}, hex("03 00 00 00 00 00 3e 80 00 00 00 01 00 00 00 40"),
           {1, 2, 3}),
    layout("Volume", Volume{3}, hex("03")),
    layout("SteeringOrder", SteeringOrder{168496141, {0.15, -0.06, 1.2}},
           hex("0a 0b 0c 0d") + hex(kVelocity) + hex("00 00"), {10, 11}),
    layout("SteeringReply", SteeringReply{{0.15, -0.06, 1.2}, 0xabcd}, hex(kVelocity) + hex("ab cd")),
    layout("OutermostVelocity", Velocity{-32.768, 32.767, -0.001}, hex("80 00 7f ff ff ff")),
    layout("RoundedVelocity", Velocity{0.0014, 0.0015, -0.0015}, hex("00 01 00 02 ff fe")),
    layout("PostureOrder", PostureOrder{168496141}, hex("0a 0b 0c 0d")),
    layout("MotionUpload", MotionUpload{"NOD.MTN", kMotion, 4}, hex(kUpload), {}, {9, 10, 11}, true),
    layout("MotionToDelete", MotionToDelete{"NOD.MTN"}, bytesOf("NOD.MTN")),
    layout("MotionOrder", MotionOrder{168496141, 3, "NOD.MTN"}, hex(kOrder)),
    layout("StopOfAllMotions", MotionOrder{}, hex("00 00 00 00 00 00")),
    layout("MotionChanges", MotionChanges{"clip", 4}, bytesOf("clip"), {}, {0, 1, 2, 3}, true),
    layout("StickPicture", StickPicture{"AIBO0001.JPG"}, bytesOf("AIBO0001.JPG")),
    layout("FetchedPicture", FetchedPicture{kJpeg, 2}, hex("ff d8"), {}, {1}, true),
    listLayout("MotionList", FileList{2, {"NOD.MTN", "WAG.MTN"}}, bytesOf("NOD.MTN\nWAG.MTN"), readMotionName, {0, 7}),
    listLayout("PictureList", FileList{2, {"A.JPG", "AIBO0001.JPG"}}, bytesOf("A.JPG\nAIBO0001.JPG"), readPictureName,
               {0, 5}),
    layout("DatagramOrder", DatagramOrder{54321, true, 0x12345678, 0x9abcdef0},
           hex("d4 31 01 00 12 34 56 78 9a bc de f0"), {3}),
    layout("DatagramStatus", DatagramStatus{2, 0x9abcdef0, 5}, hex("73 00 00 02 9a bc de f0 00 00 00 05"), {1}),
    layout("Picture", PicturePayload{{66051, 168496141, 208, 160, 85, LAYER_HIGH, {}}, kJpeg, 4}, hex(kPicture), {},
           {17, 18, 19}, true),
    layout("PictureWithSettings", PicturePayload{{0, 0, 416, 320, 85, LAYER_DOUBLE, {{3, 2, 1, 0, 1}}}, kJpeg, 1},
           hex("00 00 00 00 00 00 00 00 01 a0 01 40 55 03 00 9b ff"), {}, {}, true),
    layout("ErrorMessage", ErrorMessage{CODE_NOT_SUPPORTED, "\xc3\xa9", 2}, hex("00 02 c3 a9"), {}, {2}, true),
    layout("EndMessage", EndMessage{ENDED_MOTION, END_REPLACED, 43981, "NOD.MTN", 7, "c\xc3\xa9", 3}, hex(kEnd), {},
           {12, 13}, true),
};

class EveryLayout : public ::testing::TestWithParam<Layout> {};

TEST_P(EveryLayout, StandsForItsValue) {
  EXPECT_EQ(GetParam().encode(), GetParam().payload);
  EXPECT_THAT(GetParam().decode(GetParam().payload), IsNull());
  EXPECT_EQ(GetParam().encode_again(GetParam().payload), GetParam().payload);
}

TEST_P(EveryLayout, IsRefusedWhenBytesAreMissing) {
  const std::vector<size_t>& whole_at = GetParam().whole_at;
  for (size_t size = 0; size < GetParam().payload.size(); ++size) {
    const bool is_whole = std::find(whole_at.begin(), whole_at.end(), size) != whole_at.end();
    EXPECT_EQ(GetParam().decode(firstOf(GetParam().payload, size)) == nullptr, is_whole) << size;
  }
}

TEST_P(EveryLayout, IsRefusedWithAByteTooMany) {
  if (!GetParam().takes_more) {
    EXPECT_THAT(GetParam().decode(GetParam().payload + Bytes{0}), NotNull());
  }
}

TEST_P(EveryLayout, IsRefusedWithAReservedByteInUse) {
  for (const size_t offset : GetParam().reserved) {
    Bytes payload = GetParam().payload;
    payload[offset] = 1;
    EXPECT_THAT(GetParam().decode(payload), HasSubstr("reserved")) << offset;
  }
}

INSTANTIATE_TEST_SUITE_P(Version2, EveryLayout, ::testing::ValuesIn(kLayouts),
                         [](const auto& layout) { return std::string(layout.param.name); });

// Bytes changed in a payload that is accepted.
Bytes changed(const char* digits, const std::map<size_t, unsigned char>& changes) {
  Bytes bytes = hex(digits);
  for (const auto& [offset, value] : changes) {
    bytes.at(offset) = value;
  }
  return bytes;
}

Bytes colorTable(unsigned char channel, const ColorSegment& last) {
  ColorTable table{channel, {}};
  table.segments[31] = last;
  return encoded(table);
}

template <int setting>
const char* verdictOnCamera(const Bytes& bytes) {
  CameraValue value{setting, 0};
  return decode(bytes.data(), bytes.size(), &value);
}

const char* verdictOnMotions(const Bytes& bytes) {
  FileList list{};
  return decodeFileList(readMotionName, bytes.data(), bytes.size(), &list);
}

Bytes namesOfMotions(size_t count) {
  std::string names = "MOVE1000.MTN";
  for (size_t i = 1; i < count; ++i) {
    names += "\nMOVE" + std::to_string(1000 + i) + ".MTN";
  }
  return bytesOf(names);
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

// A push of `count` values that announces `announced` values.
Bytes telemetryOf(size_t count, unsigned announced) {
  Bytes bytes{0, 0, 0, 1, static_cast<unsigned char>(announced >> 8), static_cast<unsigned char>(announced), 0, 0};
  for (size_t i = 0; i < count; ++i) {
    bytes = bytes + hex("53 01 00 00 00 00 00 00");
  }
  return bytes;
}

struct Verdict {
  const char* (*decode)(const Bytes&);
  Bytes payload;
  const char* problem;  ///< part of the text; NULL if the payload is accepted
};

const Verdict kVerdicts[] = {
    {verdict<NoPayload>, {}, NULL},
    {verdict<NoPayload>, hex("00"), "size"},
    {verdict<PictureRequest>, hex("03"), NULL},
    {verdict<PictureRequest>, hex("04"), "layer"},
    {verdict<StreamSettings>, hex("00 00 00 01"), NULL},
    {verdict<StreamSettings>, hex("02 00 00 01"), "neither off (0) nor on (1)"},
    {verdict<StreamSettings>, hex("01 04 00 01"), "layer"},
    {verdict<StreamSettings>, hex("01 00 00 00"), "interval is 0"},
    {verdict<JointTargets>, hex("00 00 00 00"), NULL},
    {verdict<MotorState>, hex("00"), NULL},
    {verdict<MotorState>, hex("02"), "motors"},
    {verdict<MotorsAndPosture>, hex("01 4d 00 00"), NULL},  // of a newer server
    {verdict<MotorsAndPosture>, hex("02 01 00 00"), "motors"},
    {verdict<LedValues>, hex("01 ff 02 00"), "mode"},
    {verdict<EarPositions>, hex("02 00"), "ear"},
    {verdict<Telemetry>, changed(kThreeValues, {{16, GROUP_DUTY}}), NULL},
    {verdict<Telemetry>, changed(kThreeValues, {{16, GROUP_WALK}}), NULL},
    {verdict<Telemetry>, changed(kThreeValues, {{16, 'L'}}), "not one of J, S, D and W"},
    {verdict<PicturePayload>, changed(kPicture, {{9, 0}}), "no width"},
    {verdict<PicturePayload>, changed(kPicture, {{12, 101}}), "quality"},
    {verdict<PicturePayload>, changed(kPicture, {{13, 3}}), NULL},
    {verdict<PicturePayload>, changed(kPicture, {{13, 4}}), "layer"},
    {verdict<PicturePayload>, changed(kPicture, {{14, 1}}), "camera setting"},
    {verdict<PicturePayload>, firstOf(hex(kPicture), IMAGE_HEADER_SIZE), "no picture"},
    {verdict<ErrorMessage>, hex("ff fe"), NULL},  // of a newer server
    {verdict<ErrorMessage>, hex("00 00 1b 5b 32 4a"), "control"},
    {verdict<ErrorMessage>, hex("00 00 ff fe"), "UTF-8"},
    {verdict<EndMessage>, hex("c8 c9 00 00 0a"), NULL},  // of a newer server
    {verdict<EndMessage>, hex("01 00 00 00 1b 0a"), "control"},
    {verdict<EndMessage>, hex("01 00 00 00 0a ff"), "UTF-8"},
    {verdict<EndMessage>, hex("01 00 00 00 41"), "newline"},
    {verdict<ColorSettings>, hex("00 00 00 00"), "interval is 0"},
    {verdict<ColorSettings>, hex("00 01 02 00"), "neither 0 nor 1"},
    {verdict<ColorTable>, colorTable(7, {}), NULL},
    {verdict<ColorTable>, colorTable(8, {}), "0 to 7"},
    {verdict<ColorTable>, colorTable(0, {200, 199, 0, 0}), "minimum above its maximum"},
    {verdict<ColorRegions>, changed(kColorRegions, {{36, 0}}), "ascending"},  // the second channel
    {verdict<ColorRegions>, changed(kColorRegions, {{36, 8}}), "0 to 7"},
    {verdict<ColorRegions>, changed(kColorRegions, {{12, 9}}), "more channels"},
    {verdict<ColorRegions>, changed(kColorRegions, {{12, 1}}), "count"},
    {verdict<ColorRegions>, changed(kColorRegions, {{9, 0}}), "no pixels"},
    {verdict<ColorRegions>, changed(kColorRegions, {{13, 1}}), "count"},  // a plane without bytes
    {verdict<ColorRegions>, changed(kColorRegions, {{13, 1}}) + hex("00 00"), NULL},
    {verdict<MotionUpload>, {}, "does not fit"},
    {verdict<MotionUpload>, changed(kUpload, {{0, 12}}), "does not fit"},
    {verdict<MotionUpload>, changed(kUpload, {{0, 0}}), ".MTN"},
    {verdict<MotionUpload>, bytesOf("\x08../A.MTNxyz"), "characters other than"},
    {verdict<MotionUpload>, bytesOf("\x07NOD.MTN"), "no motion after its name"},
    {verdict<MotionToDelete>, bytesOf("wag.mtn"), NULL},
    {verdict<MotionToDelete>, {}, ".MTN"},
    {verdict<MotionOrder>, hex("00 00 00 00 00 00") + bytesOf("NOD.MTN"), NULL},
    {verdict<MotionOrder>, hex("00 00 00 00 00 01"), ".MTN"},
    {verdict<MotionOrder>, hex("00 00 00 00 00 01") + bytesOf("A/B.MTN"), "characters other than"},
    {verdict<MotionChanges>, bytesOf("a\nb"), "plain"},
    {verdict<MotionChanges>, hex("ff"), "plain"},
    {verdict<MotionChanges>, Bytes(MAX_MOTION_CHANGES_SIZE, 'a'), NULL},
    {verdict<MotionChanges>, Bytes(MAX_MOTION_CHANGES_SIZE + 1, 'a'), "too long"},
    {verdict<JointTargets>, hex("00 00 20 00") + entriesOf(32, kJoint), NULL},
    {verdict<JointTargets>, hex("00 00 21 00") + entriesOf(33, kJoint), "more joints"},
    {verdict<JointTargets>, hex("00 00 02 00") + entriesOf(3, kJoint), "count"},
    {verdict<JointTargets>, hex("00 00 02 00") + entriesOf(1, kJoint) + entriesOf(1, kJoint), "twice"},
    {verdict<SpeedLimits>, entriesOf(32, kJoint), NULL},
    {verdict<SpeedLimits>, entriesOf(33, kJoint), "more joints"},
    {verdict<SpeedLimits>, entriesOf(2, kJoint) + entriesOf(1, kJoint), "twice"},
    {verdict<LedValues>, entriesOf(32, kLed), NULL},
    {verdict<LedValues>, entriesOf(33, kLed), "more LEDs"},
    {verdict<LedValues>, entriesOf(2, kLed) + entriesOf(1, kLed), "twice"},
    {verdict<JointIds>, entriesOf(32, ""), NULL},
    {verdict<JointIds>, entriesOf(33, ""), "more joints"},
    {verdict<JointIds>, {}, "no joint"},
    {verdict<JointIds>, hex("02 03 02"), "twice"},
    {verdict<Telemetry>, telemetryOf(128, 128), NULL},
    {verdict<Telemetry>, telemetryOf(129, 129), "more values"},
    {verdict<Telemetry>, telemetryOf(2, 1), "count"},
    {verdictOnCamera<SETTING_GAIN>, hex("03"), NULL},
    {verdictOnCamera<SETTING_GAIN>, hex("04"), "1, 2 or 3"},
    {verdictOnCamera<SETTING_AUTO_EXPOSURE>, hex("01"), NULL},
    {verdictOnCamera<SETTING_AUTO_EXPOSURE>, hex("02"), "neither off (0) nor on (1)"},
    {verdict<PicturePayload>, changed(kPicture, {{14, 0x01}, {15, 0x15}}), "reserved"},
    {verdictOnMotions, namesOfMotions(256), NULL},
    {verdictOnMotions, namesOfMotions(257), "more than 256"},
    {verdictOnMotions, bytesOf("NOD.MTN\n"), ".MTN"},
    {verdictOnMotions, bytesOf("NOD.MTN\r\nWAG.MTN"), ".MTN"},
    {verdictOnMotions, bytesOf("../A.MTN"), "characters other than"},
};

TEST(Payloads, AreRefusedForTheRightReason) {
  for (const Verdict& row : kVerdicts) {
    const char* const problem = row.decode(row.payload);
    EXPECT_EQ(problem == nullptr, row.problem == nullptr) << &row - kVerdicts;
    EXPECT_THAT(problem == nullptr ? "" : problem, HasSubstr(row.problem == nullptr ? "" : row.problem));
  }
}

}  // namespace
}  // namespace version2
}  // namespace protocol
