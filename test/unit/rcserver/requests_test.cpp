// docs/protocol.md, "Version 2": its table of requests is the table of this test.

#include <filesystem>

#include "motion_bytes.h"
#include "protocol/color_requests.h"
#include "protocol/hello.h"
#include "protocol/picture_datagram.h"
#include "protocol/sound_requests.h"
#include "protocol/stick_pictures.h"
#include "rcserver_fixture.h"

namespace {

using namespace protocol::version2;
using ::testing::HasSubstr;

constexpr char kEverything[] =
    "ALLOW_UPLOAD=yes\nALLOW_DELETE=yes\nALLOW_PICTURES=yes\nALLOW_MICROPHONE=yes\nALLOW_SHUT_DOWN=yes\n"
    "ALLOW_REBOOT=yes\n";

template <size_t size>
std::string literal(const char (&characters)[size]) {
  return {characters, size - 1};
}

std::string limitsOf(unsigned char joint, int limit) {
  return payloadOf(SpeedLimits{2, {{1, 1000000}, {joint, limit}}});
}

std::string ledsOf(unsigned char id) {
  return payloadOf(LedValues{2, {{7, 9, LED_MODE_A}, {id, 99, LED_MODE_B}}});
}

std::string tableOfColors(unsigned char channel, unsigned char least, unsigned char most) {
  ColorTable colors = {channel, {}};
  std::fill(std::begin(colors.segments), std::end(colors.segments), ColorSegment{least, most, 0, 255});
  return payloadOf(colors);
}

std::string soundFrom(unsigned position) {
  const unsigned char samples[] = {0, 1, 0, 2};
  return payloadOf(PlayedSound{position, true, samples, sizeof(samples)});
}

// A motion with a joint that an ERS-7 does not have.
constexpr char kForeign[] = "at 0 PRM:/r9/c1-Joint2:91 0 head_pan 0\n";

struct AnsweredRequest {
  char kind;
  int id;
  std::string payload;
  int reply_id;
  std::string reply;
};

// H, F, M, Q and R, whose replies depend on more, are below and in other files.
const AnsweredRequest kAnswered[] = {
    {'W', 255, payloadOf(StreamSettings{true, LAYER_MIDDLE, 3}), 85, payloadOf(StreamSettings{true, LAYER_MIDDLE, 3})},
    {'J', 0, order(targetsOf({{2, 500000}})), 0, targetsOf({{2, 500000}})},
    {'J', 0, order(targetsOf({{2, 2000000000}})), 0, targetsOf({{2, 1535890}})},
    {'V', 0, payloadOf(SpeedLimits{1, {{1, 2000000000}}}), 0, payloadOf(SpeedLimits{1, {{1, 3185226}}})},
    {'T', TELEMETRY_WITH_DUTY, literal("\0\5"), TELEMETRY_WITH_DUTY, literal("\0\10")},
    {'T', 4, literal("\0\4"), 0, literal("\0\4")},  // a bit of the future
    {'T', 0, literal("\0\0"), 0, literal("\0\0")},
    {'T', 0, literal("\0\1"), 0, literal("\0\4")},
    {'T', 0, literal("\377\377"), 0, literal("\377\374")},
    {'O', 0, "", 0, "\1"},
    {'O', 0, order("\1"), 0, "\1"},
    {'O', 0, order(literal("\0")), 0, literal("\0")},
    {'I', HOLD_EVERYTHING, "", 0, ""},
    {'I', HOLD_JOINTS, "\1\2", HOLD_JOINTS, ""},
    {'S', 0, order(payloadOf(SteeringReply{{0, 0, 0}, 0})), 0, payloadOf(SteeringReply{{0, 0, 0}, 0})},
    {'S', STEER_GUARDED, order(payloadOf(SteeringReply{{0, 0, 0}, 0})), STEER_GUARDED,
     payloadOf(SteeringReply{{0, 0, 0}, 0})},
    {'E', POSTURE_SIT, order(), POSTURE_SIT, ""},
    {'L', 0, payloadOf(LedValues{2, {{1, 3, LED_MODE_B}, {7, 77, LED_MODE_B}}}), 0,
     payloadOf(LedValues{2, {{1, 255, LED_MODE_A}, {7, 77, LED_MODE_B}}})},
    {'K', 0, literal("\1\0"), 0, literal("\1\0")},
    {'B', 0, payloadOf(DatagramOrder{0, false, 5, 7}), 0, payloadOf(DatagramOrder{0, false, 5, 7})},
    {'G', SETTING_GAIN, "", SETTING_GAIN, "\2"},
    {'G', SETTING_GAIN, "\3", SETTING_GAIN, "\3"},
    {'Z', COLORS_OFF, "", COLORS_OFF, ""},
    {'Z', COLORS_ON, payloadOf(ColorSettings{2, true}), COLORS_ON, payloadOf(ColorSettings{2, true})},
    {'Z', COLORS_TABLE, tableOfColors(6, 1, 2), COLORS_TABLE, ""},
    {'A', SOUND_MICROPHONE, payloadOf(MicrophoneSettings{MICROPHONE_ON, 2, 8000}), SOUND_MICROPHONE,
     payloadOf(MicrophoneSettings{MICROPHONE_ON, 2, 8000})},
    {'A', SOUND_SPEAKER, payloadOf(PlayedSound{0, false, nullptr, 0}), SOUND_SPEAKER, payloadOf(SpeakerRoom{16384})},
    {'A', SOUND_VOLUME, "", SOUND_VOLUME, "\2"},
    {'A', SOUND_VOLUME, "\3", SOUND_VOLUME, "\3"},
    {'P', 0, playPayload("nod.mtn", 1), 0, ""},
    {'P', 0, playPayload("", 0), 0, ""},
    {'N', 0, "", 0, "LIE.MTN\nNOD.MTN\nSIT.MTN\nWAG.MTN"},
    {'U', 0, uploadPayload("NEW.MTN", motionBytes("at 0 head_pan 0\n")), 0, ""},
    {'U', protocol::version2::LEAVE_OUT_MISSING_JOINTS, uploadPayload("NEW.MTN", motionBytes(kForeign)),
     protocol::version2::LEAVE_OUT_MISSING_JOINTS, ""},
    {'D', 0, "nod.mtn", 0, ""},
    {'Y', LIST_PICTURES, "", LIST_PICTURES, "A.JPG"},
    {'Y', FETCH_PICTURE, "a.jpg", FETCH_PICTURE, "picture"},
    {'Y', DELETE_PICTURE, "A.JPG", DELETE_PICTURE, ""},
};

struct RefusedRequest {
  char kind;
  int id;
  std::string payload;
  int code;
  const char* problem;
};

const RefusedRequest kRefusals[] = {
    {'F', 85, "\4", CODE_REFUSED, "bad request"},
    {'F', 85, "\3", CODE_NOT_SUPPORTED, "double"},  // this camera has no fine detail
    {'W', 85, "abc", CODE_REFUSED, "bad request"},
    {'W', 85, literal("\1\3\0\1"), CODE_NOT_SUPPORTED, "double"},
    {'W', 85, literal("\0\0\0\0"), CODE_REFUSED, "interval is 0"},
    {'J', 0, "abc", CODE_REFUSED, "bad request"},
    {'J', 0, order(targetsOf({{2, 500000}, {99, 0}})), CODE_REFUSED, "no joint 99"},
    {'J', 0, order(targetsOf({{99, 0}, {2, 0}})), CODE_REFUSED, "no joint 99"},
    {'J', 0, order(targetsOf({{2, 1}, {2, 0}})), CODE_REFUSED, "twice"},
    {'V', 0, "abc", CODE_REFUSED, "bad request"},
    {'V', 0, limitsOf(99, 1), CODE_REFUSED, "no joint 99"},
    {'V', 0, limitsOf(2, 0), CODE_REFUSED, "above 0"},
    {'T', 0, "abc", CODE_REFUSED, "bad request"},
    {'O', 0, order("\2"), CODE_REFUSED, "bad request"},
    {'O', 0, "ab", CODE_REFUSED, "bad request"},
    {'I', HOLD_JOINTS, "\2\143", CODE_REFUSED, "no joint 99, so the whole request was refused"},
    {'I', HOLD_JOINTS, "", CODE_REFUSED, "no joint is named"},
    {'I', HOLD_EVERYTHING, "\2", CODE_REFUSED, "bad request: the payload"},
    {'I', 2, "", CODE_REFUSED, "the id is neither 0"},
    {'S', 0, "abc", CODE_REFUSED, "bad request"},
    {'E', 4, order(), CODE_REFUSED, "the id is not one of the postures"},
    {'E', POSTURE_SIT, order("a"), CODE_REFUSED, "bad request"},
    {'L', 0, "abc", CODE_REFUSED, "bad request"},
    {'L', 0, ledsOf(99), CODE_REFUSED, "LED 99"},
    {'L', 0, ledsOf(7), CODE_REFUSED, "twice"},
    {'K', 0, "\1\2", CODE_REFUSED, "bad request"},
    {'B', 0, "\1", CODE_REFUSED, "bad request"},
    {'G', 6, "\1", CODE_REFUSED, "id"},
    {'G', SETTING_GAIN, "\4", CODE_REFUSED, "1, 2 or 3"},
    {'Z', 3, "", CODE_REFUSED, "the id is not"},
    {'Z', COLORS_OFF, "a", CODE_REFUSED, "bad request"},
    {'Z', COLORS_ON, payloadOf(ColorSettings{0, false}), CODE_REFUSED, "interval is 0"},
    {'Z', COLORS_TABLE, "abc", CODE_REFUSED, "size"},
    {'Z', COLORS_TABLE, tableOfColors(0, 200, 100), CODE_REFUSED, "minimum above its maximum"},
    {'Z', COLORS_TABLE, tableOfColors(7, 0, 255), CODE_REFUSED, "no channel 7"},
    {'A', 4, "", CODE_REFUSED, "the id is not"},
    {'A', SOUND_MICROPHONE, payloadOf(MicrophoneSettings{1, 3, 16000}), CODE_REFUSED, "one or two channels"},
    {'A', SOUND_MICROPHONE, payloadOf(MicrophoneSettings{1, 1, 16001}), CODE_REFUSED, "neither 8000 nor 16000"},
    {'A', SOUND_SPEAKER, std::string(9, '\0'), CODE_REFUSED, "half a sample"},
    {'A', SOUND_SPEAKER, soundFrom(100), CODE_REFUSED, "begins with the sample at position 0"},
    {'A', SOUND_VOLUME, "\4", CODE_REFUSED, "0 to 3"},
    {'P', 0, playPayload("../NOD.MTN", 1), CODE_REFUSED, "bad request"},
    {'P', 0, playPayload("NONE.MTN", 1), CODE_FILE_MISSING, "there is no NONE.MTN on the memory stick"},
    {'P', 0, playPayload("BAD.MTN", 1), CODE_REFUSED, "BAD.MTN is not a motion file"},
    {'N', 0, "a", CODE_REFUSED, "bad request"},
    {'U', 0, uploadPayload("../NOD.MTN", "x"), CODE_REFUSED, "bad request"},
    {'U', 0, uploadPayload("WAG~1.MTN", "x"), CODE_REFUSED, "could stand for another file"},
    {'U', 0, uploadPayload("NEW.MTN", "OMTN"), CODE_REFUSED, "NEW.MTN is not a motion file"},
    {'U', 0, uploadPayload("NEW.MTN", std::string(64001, 'x')), CODE_REFUSED, "64001 bytes are too many"},
    {'U', 0, uploadPayload("NEW.MTN", motionBytes(kForeign)), CODE_REFUSED, "which this robot does not have"},
    {'D', 0, "../NOD.MTN", CODE_REFUSED, "bad request"},
    {'D', 0, "NONE.MTN", CODE_FILE_MISSING, "there is no NONE.MTN"},
    {'M', 85, "A.JPG", CODE_REFUSED, "bad request"},
    {'Y', 0, "", CODE_REFUSED, "the id is not one of 1 (list), 2 (fetch) and 3 (delete)"},
    {'Y', LIST_PICTURES, "x", CODE_REFUSED, "bad request"},
    {'Y', FETCH_PICTURE, "../A.JPG", CODE_REFUSED, "bad request: the name has characters other"},
    {'Y', DELETE_PICTURE, "NOD.MTN", CODE_REFUSED, "bad request: the name of the picture"},
    {'Y', FETCH_PICTURE, "NONE.JPG", CODE_FILE_MISSING,
     "there is no NONE.JPG on the memory stick, in OPEN-R/MW/DATA/P"},
    {'Y', DELETE_PICTURE, "NONE.JPG", CODE_FILE_MISSING, "there is no NONE.JPG"},
    {'Q', 0, "x", CODE_REFUSED, "bad request"},
    {'R', 0, "x", CODE_REFUSED, "bad request"},
    {'C', 0, "", CODE_NOT_SUPPORTED, "H F W J V T O I L K G Z B P N A S E U D M Y Q R"},
};

// The problem is the setting.
const RefusedRequest kNotAllowed[] = {
    {'A', SOUND_MICROPHONE, payloadOf(MicrophoneSettings{MICROPHONE_ON, 1, 8000}), CODE_REFUSED,
     "ALLOW_MICROPHONE=yes"},
    {'A', SOUND_SPEAKER, soundFrom(0), CODE_REFUSED, "ALLOW_SOUND=yes"},
    {'A', SOUND_VOLUME, "\3", CODE_REFUSED, "ALLOW_SOUND=yes"},
    {'U', 0, uploadPayload("NEW.MTN", "x"), CODE_REFUSED, "ALLOW_UPLOAD=yes"},
    {'D', 0, "NOD.MTN", CODE_REFUSED, "ALLOW_DELETE=yes"},
    {'M', 85, "", CODE_REFUSED, "ALLOW_PICTURES=yes"},
    {'Y', LIST_PICTURES, "", CODE_REFUSED, "ALLOW_PICTURES=yes"},
    {'Y', FETCH_PICTURE, "A.JPG", CODE_REFUSED, "ALLOW_PICTURES=yes"},
    {'Y', DELETE_PICTURE, "A.JPG", CODE_REFUSED, "ALLOW_PICTURES=yes"},
    {'Y', DELETE_PICTURE, "A.JPG", CODE_REFUSED, "ALLOW_DELETE=yes"},
    {'Q', 0, "", CODE_REFUSED, "ALLOW_SHUT_DOWN=yes"},
    {'R', 0, "", CODE_REFUSED, "ALLOW_REBOOT=yes"},
};

class Requests : public FakeRobotFixture {
 protected:
  // A new robot, and what it answers.
  Frame answerOfNewRobot(const std::string& settings, char kind, int id, const std::string& payload) {
    stick_.write("OPEN-R/MW/DATA/P/A.JPG", "picture");
    robot_.color_plane.assign(104 * 80, 0);
    startWith(settings);
    connectVersion2();
    return ask(kind, id, payload);
  }
};

TEST_F(Requests, AreAnsweredAsTheDocumentSays) {
  for (const AnsweredRequest& row : kAnswered) {
    SCOPED_TRACE(std::string(1, row.kind) + std::to_string(row.id) + " row " + std::to_string(&row - kAnswered));
    std::filesystem::copy(MEMORY_STICK "/OPEN-R/MW/DATA/P", stick_.path("OPEN-R/MW/DATA/P"),
                          std::filesystem::copy_options::skip_existing);
    const Frame answer = answerOfNewRobot(kEverything, row.kind, row.id, row.payload);
    EXPECT_EQ(answer.header.kind, std::tolower(row.kind));
    EXPECT_EQ(answer.header.id, row.reply_id);
    EXPECT_EQ(textOf(answer), row.reply);
  }
}

TEST_F(Requests, AreRefusedAsAWholeAndTheConnectionGoesOn) {
  stick_.write("OPEN-R/MW/DATA/P/BAD.MTN", "OMTN and nothing more");
  for (const RefusedRequest& row : kRefusals) {
    SCOPED_TRACE(std::string(1, row.kind) + std::to_string(row.id) + " row " + std::to_string(&row - kRefusals));
    expectRefusal(answerOfNewRobot(kEverything, row.kind, row.id, row.payload), row.code, row.problem);
    const std::vector<int> before = positions();
    passFrames(100);
    EXPECT_EQ(positions(), before);
    EXPECT_EQ(robot_.led("face_1").intensity, 0);
    EXPECT_EQ(answerTo('H', 0).header.kind, 'h');
  }
}

TEST_F(Requests, AreRefusedUnlessTheOwnerAllowsThem) {
  for (const RefusedRequest& row : kNotAllowed) {
    SCOPED_TRACE(std::string(1, row.kind) + std::to_string(row.id));
    std::string others = std::string(kEverything) + "ALLOW_SOUND=yes\n";
    const std::string setting = row.problem;
    others.replace(others.find(setting), setting.size(), setting.substr(0, setting.find('=')) + "=no");
    expectRefusal(answerOfNewRobot(others, row.kind, row.id, row.payload), CODE_REFUSED,
                  "this is not allowed; " + setting + " in RCSERVER.CFG");
    passFrames(20);
    EXPECT_TRUE(machine_->isOn());
    EXPECT_TRUE(std::filesystem::exists(stick_.path("OPEN-R/MW/DATA/P/NOD.MTN")));
    EXPECT_TRUE(std::filesystem::exists(stick_.path("OPEN-R/MW/DATA/P/A.JPG")));
    EXPECT_FALSE(std::filesystem::exists(stick_.path("OPEN-R/MW/DATA/P/NEW.MTN")));
  }
}

TEST_F(Requests, AreRefusedWithTheWrongLineWhileTheFileIsIgnored) {
  for (const RefusedRequest& row : kNotAllowed) {
    expectRefusal(answerOfNewRobot(std::string(kEverything) + "#\nALLOW_EVERYTHING=yes", row.kind, row.id, row.payload),
                  CODE_REFUSED, "RCSERVER.CFG on the memory stick is ignored: line 8: there is no such setting");
  }
}

TEST_F(Requests, ThatAreCarriedOutAreThoseOfTheHello) {
  EXPECT_THAT(textOf(answerOfNewRobot("", 'H', 0, "")),
              HasSubstr("capabilities=H F W J V T O I L K G Z B P N A S E\n"));
  EXPECT_THAT(textOf(answerOfNewRobot(kEverything, 'H', 0, "")),
              HasSubstr("capabilities=H F W J V T O I L K G Z B P N A S E U D M Y Q R\n"));
}

TEST_F(Requests, OfEveryOtherKindAreNotSupported) {
  start();
  connectVersion2();
  for (int kind = 0; kind < 256; ++kind) {
    if (std::string("HFWJVTOILKGZBXPNASEUDMYQR").find(static_cast<char>(kind)) == std::string::npos) {
      expectRefusal(answerTo(static_cast<char>(kind), 1, "abc"), CODE_NOT_SUPPORTED,
                    "H F W J V T O I L K G Z B P N A S E");
    }
  }
}

TEST_F(Requests, WithoutANumberAreRefused) {
  start();
  connectVersion2();
  send(frame('H', 0, 0));
  expectRefusal(*nextFrame(), CODE_REFUSED, "number");
}

TEST_F(Requests, OfMoreThan64KilobytesEndTheConnectionWithAReason) {
  start();
  connectVersion2();
  sendAll(frame('C', 0, 41, std::string(MAX_PAYLOAD_TOWARDS_ROBOT, 'z')));
  expectRefusal(*nextFrame(), CODE_NOT_SUPPORTED, "not supported");
  std::string too_large(FRAME_HEADER_SIZE, '\0');
  encode(FrameHeader{'C', 0, 42, MAX_PAYLOAD_TOWARDS_ROBOT + 1}, reinterpret_cast<unsigned char*>(too_large.data()));
  send(too_large);
  expectRefusal(*nextFrame(), CODE_REFUSED, "too large");
  EXPECT_TRUE(awaitEnd(*client_));
}

}  // namespace
