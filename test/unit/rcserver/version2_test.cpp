// Version 2 of the protocol.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "picture_checks.h"
#include "protocol/hello.h"
#include "protocol/version2.h"
#include "rcserver/camera/ImageObserver.h"
#include "rcserver/joints/JointControl.h"
#include "rcserver_fixture.h"

namespace {

using namespace protocol::version2;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;

constexpr unsigned char kNeckTiltId = 1;
constexpr unsigned char kPanId = 2;
constexpr unsigned char kTailPanId = 51;
constexpr unsigned char kNoJoint = 99;

constexpr unsigned kLongestCommand = 500;

std::string pictureOf(Layer layer) {
  return payloadOf(PictureRequest{layer});
}

std::string stream(bool on, Layer layer = LAYER_HIGH, unsigned short every_nth_image = 1) {
  return payloadOf(StreamSettings{on, layer, every_nth_image});
}

using Values = std::vector<std::pair<unsigned char, int>>;

std::string targets(const Values& joints, unsigned short duration = 0) {
  JointTargets targets = {duration, static_cast<unsigned char>(joints.size()), {}};
  for (size_t i = 0; i < joints.size(); ++i) {
    targets.joints[i] = {joints[i].first, joints[i].second};
  }
  return payloadOf(targets);
}

std::string limits(const Values& joints) {
  SpeedLimits limits = {static_cast<unsigned char>(joints.size()), {}};
  for (size_t i = 0; i < joints.size(); ++i) {
    limits.joints[i] = {joints[i].first, joints[i].second};
  }
  return payloadOf(limits);
}

std::string period(unsigned short frames) {
  return payloadOf(TelemetryPeriod{frames});
}

class Version2Test : public Version2Fixture {
 protected:
  // The values of a reply to `J`.
  Values acceptedBy(const Frame& answer) {
    JointTargets accepted = {};
    EXPECT_EQ(answer.header.kind, 'j');
    EXPECT_EQ(decode(answer.payload.data(), answer.payload.size(), &accepted), nullptr);
    return values(accepted.joints, accepted.count);
  }

  Values limitsIn(const Frame& answer) {
    SpeedLimits limits = {};
    EXPECT_EQ(answer.header.kind, 'v');
    EXPECT_EQ(decode(answer.payload.data(), answer.payload.size(), &limits), nullptr);
    return values(limits.joints, limits.count);
  }

  static Values values(const JointValue* joints, size_t count) {
    Values all;
    for (size_t i = 0; i < count; ++i) {
      all.emplace_back(joints[i].id, joints[i].value);
    }
    return all;
  }

  bool motorsAfter(const std::string& payload) {
    MotorState state = {};
    const Frame answer = answerTo('O', 0, payload);
    EXPECT_EQ(answer.header.kind, 'o');
    EXPECT_EQ(decode(answer.payload.data(), answer.payload.size(), &state), nullptr);
    return state.on;
  }

  Hello hello() {
    Hello hello = {};
    const Frame answer = answerTo('H', 0);
    EXPECT_EQ(answer.header.kind, 'h');
    EXPECT_EQ(decodeHello(answer.payload.data(), answer.payload.size(), &hello), nullptr);
    return hello;
  }

  Picture nextPicture() {
    for (std::optional<Frame> next = nextFrame(); next; next = nextFrame()) {
      if (next->header.kind == PICTURE) {
        return pictureIn(*next);
      }
    }
    ADD_FAILURE() << "no picture";
    return {};
  }

  // Everything that has arrived, which must be telemetry.
  std::vector<Telemetry> telemetry() {
    std::vector<Telemetry> all;
    for (std::optional<Frame> next = client_->nextFrame(); next; next = client_->nextFrame()) {
      EXPECT_EQ(next->header.kind, TELEMETRY_PUSH);
      EXPECT_EQ(next->header.request_number, 0);
      all.emplace_back();
      EXPECT_EQ(decode(next->payload.data(), next->payload.size(), &all.back()), nullptr);
    }
    return all;
  }

  int positionOf(const std::string& joint) { return robot_.joint(joint).position; }
};

// ------------------------------------------------------------------------------------------------- changing to version
// 2

TEST_F(Version2Test, BytesAfterTheRequestForVersion2BelongToIt) {
  disconnect();
  client_ = connect();
  const std::string bytes = request('F', 85) + request('X', 2) + frame('H', 0, 7) + frame('O', 0, 8);
  for (const size_t first_piece : {1U, 2U, 3U, 4U, 5U, 11U, 12U, 13U}) {
    SCOPED_TRACE(first_piece);
    send(bytes.substr(0, first_piece));
    send(bytes.substr(first_piece));
    const std::optional<Reply> reply = await(*client_);
    ASSERT_TRUE(reply && agreesToVersion2(reply->value));
    for (const int number : {7, 8}) {
      const std::optional<Frame> answer = nextFrame();
      ASSERT_TRUE(answer);
      EXPECT_EQ(answer->header.request_number, number);
    }
    disconnect();
    client_ = connect();
  }
}

class NewestVersionTest : public FakeRobotFixture {};

TEST_F(NewestVersionTest, ServerForVersion1RefusesVersion2AndServesOn) {
  host_.newest_version = 1;
  start();
  client_ = connectServed();
  EXPECT_EQ(answerTo(request('X', 2)).letter, 'e');
  client_->send(request('F', 85));
  takeImage();
  const std::optional<Reply> picture = await(*client_);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->letter, 'f');
}

// --------------------------------------------------------------------------------------------------------------- H

TEST_F(Version2Test, HelloHasRobotServerCapabilitiesAndLimits) {
  const Hello said = hello();
  EXPECT_STREQ(said.robot, "ERS-7");
  EXPECT_THAT(said.server, HasSubstr("aibo_rcserver"));
  for (const char* const word : {"H", "F", "W", "J", "V", "T", "O", "I", "L", "K", "P", "N"}) {
    EXPECT_TRUE(hasCapability(said, word)) << word;
  }
  for (const char* const word : {"U", "D", "Q", "R"}) {
    EXPECT_FALSE(hasCapability(said, word)) << word << " is not allowed";
  }
  ASSERT_EQ(said.joint_count, robot_.model.number_of_joints);
  for (int i = 0; i < said.joint_count; ++i) {
    EXPECT_EQ(said.joints[i].id, robot_.model.joints[i].identifier);
    EXPECT_EQ(said.joints[i].lower, robot_.model.joints[i].lowest);
    EXPECT_EQ(said.joints[i].upper, robot_.model.joints[i].highest);
    EXPECT_EQ(said.joints[i].speed, robot_.model.joints[i].highest_speed);
  }
}

TEST_F(Version2Test, HelloHasTheTime) {
  const unsigned before = hello().frame_number;
  passFrames(100);
  EXPECT_NEAR(hello().frame_number, before + 100, 4);
}

TEST_F(Version2Test, ClientSilentForFiveSecondsIsDroppedAndItsJointsHold) {
  send(frame('J', 0, 1, targets({{kPanId, 1000000}}, 60000)));
  passFrames(620);
  EXPECT_FALSE(client_->ended());
  passFrames(9);
  EXPECT_TRUE(client_->ended());
  EXPECT_THAT(console_.str(), HasSubstr("silent for 5 s"));
  passFrames(100);
  const int held = positionOf("head_pan");
  passFrames(kLongestCommand);
  EXPECT_EQ(positionOf("head_pan"), held);
}

TEST_F(Version2Test, ClientThatOnlyReadsIsSilent) {
  send(frame('T', 0, 1, period(4)));
  passFrames(629);
  EXPECT_TRUE(awaitEnd(*client_));
}

TEST_F(Version2Test, HeartbeatKeepsTheConnection) {
  for (int second = 0; second < 20; ++second) {
    hello();
    passFrames(125);
  }
  EXPECT_FALSE(client_->ended());
}

// ---------------------------------------------------------------------------------------------------------------- G

TEST_F(Version2Test, CameraSettingsAreReadWithoutTouchingTheCamera) {
  const int at_start[] = {3, 2, 2, 0, 0};
  for (int id = 1; id <= NUMBER_OF_CAMERA_SETTINGS; ++id) {
    const Frame answer = answerTo('G', id);
    EXPECT_EQ(answer.header.kind, 'g');
    EXPECT_EQ(answer.header.id, id);
    EXPECT_THAT(answer.payload, ElementsAre(at_start[id - 1]));
  }
  EXPECT_TRUE(robot_.camera_requests.empty());
}

// Requests: OPENR/OPrimitiveControl.h.
TEST_F(Version2Test, CameraSettingsGoToTheCameraAndAreInForceUntilTheClientGoes) {
  EXPECT_EQ(textOf(answerTo('G', SETTING_WHITE_BALANCE, "\x01")), "\x01");
  EXPECT_EQ(textOf(answerTo('G', SETTING_GAIN, "\x03")), "\x03");
  EXPECT_EQ(textOf(answerTo('G', SETTING_SHUTTER_SPEED, "\x01")), "\x01");
  EXPECT_EQ(textOf(answerTo('G', SETTING_AUTO_EXPOSURE, "\x01")), "\x01");
  EXPECT_EQ(textOf(answerTo('G', SETTING_AUTO_WHITE_BALANCE, "\x01")), "\x01");
  EXPECT_EQ(textOf(answerTo('G', SETTING_GAIN)), "\x03");
  using Request = std::pair<OPrimitiveRequest, longword>;
  EXPECT_THAT(robot_.camera_requests,
              ElementsAre(Request(384, 1), Request(385, 3), Request(386, 1), Request(388, 0), Request(390, 0)));
  robot_.camera_requests.clear();
  robot_.refused_camera_request = 386;
  disconnect();
  EXPECT_THAT(robot_.camera_requests, ElementsAre(Request(391, 0), Request(389, 0), Request(385, 2), Request(384, 3)))
      << "in spite of the one that is refused";
  connectVersion2();
  EXPECT_EQ(textOf(answerTo('G', SETTING_GAIN)), "\x02");
  EXPECT_EQ(textOf(answerTo('G', SETTING_SHUTTER_SPEED)), "\x01") << "as the camera has it";
  robot_.refused_camera_request.reset();
  robot_.camera_requests.clear();
  disconnect();
  EXPECT_THAT(robot_.camera_requests, ElementsAre(Request(386, 2)));
}

TEST_F(Version2Test, CameraSettingThatIsWrongOrRefusedChangesNothing) {
  expectRefusal(answerTo('G', 6, "\x01"), CODE_REFUSED, "id");
  expectRefusal(answerTo('G', 0), CODE_REFUSED, "id");
  expectRefusal(answerTo('G', SETTING_GAIN, "\x04"), CODE_REFUSED, "1, 2 or 3");
  EXPECT_TRUE(robot_.camera_requests.empty());
  answerTo('G', SETTING_GAIN, "\x01");
  robot_.refuses_camera_settings = true;
  expectRefusal(answerTo('G', SETTING_GAIN, "\x03"), CODE_REFUSED, "console");
  EXPECT_THAT(console_.str(), HasSubstr("does not take the value 3 of its setting 2"));
  for (const char* const in_force : {"\x01", "\x01", "\x02"}) {
    EXPECT_EQ(textOf(answerTo('G', SETTING_GAIN)), in_force) << "as the camera has it";
    reconnect();
    robot_.refuses_camera_settings = false;
  }
}

TEST_F(Version2Test, PicturesTellTheCamerasSettingsToAClientThatKnowsThem) {
  answerTo('W', 85, stream(true));
  takeImage();
  EXPECT_FALSE(nextPicture().image.settings.areKnown()) << "an older client refuses anything but 0 there";
  answerTo('G', SETTING_GAIN);
  takeImage();
  EXPECT_THAT(nextPicture().image.settings.values, ElementsAre(3, 2, 2, 0, 0));
  answerTo('G', SETTING_SHUTTER_SPEED, "\x03");
  takeImage();
  EXPECT_THAT(nextPicture().image.settings.values, ElementsAre(3, 2, 3, 0, 0));
  reconnect();
  answerTo('W', 85, stream(true));
  takeImage();
  EXPECT_FALSE(nextPicture().image.settings.areKnown()) << "the next client may be an older one";
}

// ---------------------------------------------------------------------------------------------------------- F and W

TEST_F(Version2Test, EachPictureRequestGetsItsOwnPictureEvenDuringAStream) {
  answerTo('W', 80, stream(true));
  send(frame('F', 20, 1001, pictureOf(LAYER_HIGH)) + frame('F', 30, 1002, pictureOf(LAYER_HIGH)));
  const std::vector<std::pair<int, int>> expected = {{1001, 20}, {1002, 30}, {0, 80}, {0, 80}};
  for (const auto& [number, quality] : expected) {
    takeImage();
    const Picture picture = nextPicture();
    EXPECT_EQ(picture.frame.request_number, number);
    EXPECT_EQ(picture.frame.id, quality);
    EXPECT_EQ(picture.image.quality, quality);
    EXPECT_EQ(quantizerOf(picture.jpeg), quantizerFor(quality));
    EXPECT_NEAR(brightnessOf(picture.jpeg).level, FakeRobot::brightness(robot_.lastImage()), 3);
  }
}

TEST_F(Version2Test, PicturesOfAllLayersHaveTheirSizes) {
  const std::map<Layer, std::pair<int, int>> sizes = {
      {LAYER_HIGH, {208, 160}}, {LAYER_MIDDLE, {104, 80}}, {LAYER_LOW, {52, 40}}};
  for (const auto& [layer, size] : sizes) {
    send(frame('F', 85, 5, pictureOf(layer)));
    takeImage();
    const Picture picture = nextPicture();
    const Brightness shown = brightnessOf(picture.jpeg);
    EXPECT_EQ(picture.image.layer, layer);
    EXPECT_EQ(picture.image.width, size.first);
    EXPECT_EQ(picture.image.height, size.second);
    EXPECT_EQ(shown.width, size.first);
    EXPECT_EQ(shown.height, size.second);
    EXPECT_NEAR(shown.level, FakeRobot::brightness(robot_.lastImage()), 3);
  }
}

TEST_F(Version2Test, CameraWithoutFineDetailHasNoDoubleResolution) {
  takeImage();
  expectRefusal(answerTo('F', 85, pictureOf(LAYER_DOUBLE)), CODE_NOT_SUPPORTED, "double");
  expectRefusal(answerTo('W', 85, stream(true, LAYER_DOUBLE)), CODE_NOT_SUPPORTED, "double");
  takeImage();
  EXPECT_FALSE(client_->nextFrame());
}

// Sony's sample W3AIBO (JPEGEncoder.cc): with the same detail d in all bands, the four pixels are Y - d, Y - d, Y - d
// and Y + 3 d. LH differs between rows, HL between columns.
TEST_F(Version2Test, DoubleResolutionIsMadeOfTheBandsOfFineDetail) {
  robot_.detail = {128 + 12, 128 + 6, 128 + 2};
  takeImage();
  answerTo('W', 95, stream(true, LAYER_DOUBLE));
  takeImage();
  const Picture picture = nextPicture();
  EXPECT_EQ(picture.image.layer, LAYER_DOUBLE);
  EXPECT_EQ(picture.image.width, 416);
  EXPECT_EQ(picture.image.height, 320);
  EXPECT_EQ(picture.image.image_count, robot_.lastImage());
  const Brightness shown = brightnessOf(picture.jpeg);
  EXPECT_EQ(shown.width, 416);
  EXPECT_EQ(shown.height, 320);
  const int level = FakeRobot::brightness(robot_.lastImage());
  ASSERT_EQ(shown.block.size(), 4U);
  EXPECT_NEAR(shown.block[0], level - 16, 4);
  EXPECT_NEAR(shown.block[1], level - 8, 4);
  EXPECT_NEAR(shown.block[2], level + 4, 4);
  EXPECT_NEAR(shown.block[3], level + 20, 4);
  send(frame('F', 85, 1000, pictureOf(LAYER_HIGH)));
  takeImage();
  for (const int part : brightnessOf(nextPicture().jpeg).block) {
    EXPECT_NEAR(part, FakeRobot::brightness(robot_.lastImage()), 4) << "of a layer that is as wide, during the stream";
  }
  send(frame('F', 85, 1001, pictureOf(LAYER_LOW)));
  takeImage();
  EXPECT_EQ(brightnessOf(nextPicture().jpeg).width, 52U);
}

TEST_F(Version2Test, PictureThatIsTooLargeForAFrameHasALowerQuality) {
  robot_.detail = {128, 128, 128};
  robot_.showNoise();
  takeImage();
  send(frame('F', 100, 5, pictureOf(LAYER_DOUBLE)));
  takeImage();
  const Picture picture = nextPicture();
  EXPECT_EQ(picture.image.quality, 25);
  EXPECT_EQ(picture.frame.id, 25);
  EXPECT_EQ(brightnessOf(picture.jpeg).width, 416);
  EXPECT_EQ(quantizerOf(picture.jpeg), quantizerFor(25));
}

TEST_F(Version2Test, QualityIsTheServersDefaultOrAtMostHundred) {
  for (const auto& [asked, used] : std::map<int, int>{{255, 85}, {254, 100}, {101, 100}, {1, 1}}) {
    send(frame('F', asked, 5, pictureOf(LAYER_HIGH)));
    takeImage();
    EXPECT_EQ(nextPicture().image.quality, used);
  }
}

TEST_F(Version2Test, ImageHeaderHasCountAndFrameOfTheImage) {
  answerTo('W', 85, stream(true));
  takeImage();
  const ImageHeader first = nextPicture().image;
  EXPECT_EQ(first.image_count, robot_.lastImage());
  EXPECT_EQ(first.frame_number, clock_.frame());
  takeImage();
  const ImageHeader second = nextPicture().image;
  EXPECT_EQ(second.image_count, first.image_count + 1);
  EXPECT_EQ(second.frame_number, first.frame_number + FakeRobot::kFramesPerImage);
}

TEST_F(Version2Test, PictureRequestsBeyondTheLimitAreRefusedAndTheOthersServed) {
  const int limit = static_cast<int>(ImageObserver::MAX_OWED);
  for (int i = 1; i <= limit; ++i) {
    send(frame('F', 85, i, pictureOf(LAYER_LOW)));
  }
  expectRefusal(answerTo('F', 85, pictureOf(LAYER_LOW)), CODE_REFUSED, "owed");
  for (int i = 1; i <= limit; ++i) {
    send(frame('H', 0, 1000 + i));
    takeImage();
    ASSERT_EQ(nextPicture().frame.request_number, i);
  }
}

TEST_F(Version2Test, StreamSettingsAreAnsweredByTheAcceptedOnes) {
  const Frame answer = answerTo('W', 255, stream(true, LAYER_MIDDLE, 3));
  EXPECT_EQ(answer.header.kind, 'w');
  EXPECT_EQ(answer.header.id, 85);
  EXPECT_EQ(textOf(answer), stream(true, LAYER_MIDDLE, 3));
  takeImage();
  EXPECT_EQ(nextPicture().image.quality, 85);
}

// --------------------------------------------------------------------------------------------------------------- J

TEST_F(Version2Test, TargetsAreClampedAndTheReplySaysSo) {
  EXPECT_THAT(acceptedBy(answerTo('J', 0, targets({{kPanId, 2000000000}, {kNeckTiltId, -2000000000}}))),
              ElementsAre(std::make_pair(kPanId, 1535890), std::make_pair(kNeckTiltId, -1308997)));
}

TEST_F(Version2Test, UnknownJointRefusesTheWholeRequest) {
  const std::vector<int> before = positions();
  expectRefusal(answerTo('J', 0, targets({{kPanId, 500000}, {kNoJoint, 0}, {kTailPanId, 0}})), CODE_REFUSED, "99");
  passFrames(kLongestCommand);
  EXPECT_EQ(positions(), before);
}

// --------------------------------------------------------------------------------------------------------------- V

TEST_F(Version2Test, SpeedLimitsAreSetAndRead) {
  const Values wanted = {{kPanId, 1000000}, {kTailPanId, 700001}, {kNeckTiltId, 2000000000}};
  EXPECT_EQ(limitsIn(answerTo('V', 0, limits(wanted))), (Values{wanted[0], wanted[1], {kNeckTiltId, 3185226}}));
  const Values all = limitsIn(answerTo('V', 0));
  ASSERT_EQ(all.size(), 18U);
  for (size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].first, robot_.model.joints[i].identifier);
    EXPECT_GT(all[i].second, 0);
  }
  EXPECT_THAT(all, AllOf(::testing::Contains(wanted[0]), ::testing::Contains(wanted[1])));
  answerTo('J', 0, targets({{kPanId, 1000000}}));
  std::vector<int>& path = robot_.joint("head_pan").path;
  path.clear();
  passFrames(kLongestCommand);
  for (size_t i = 1; i < path.size(); ++i) {
    ASSERT_LE(std::abs(path[i] - path[i - 1]), 1000000 / 125);
  }
}

TEST_F(Version2Test, SpeedLimitThatCannotBeMeantRefusesTheWholeRequest) {
  expectRefusal(answerTo('V', 0, limits({{kPanId, 1000000}, {kNoJoint, 1}})), CODE_REFUSED, "99");
  expectRefusal(answerTo('V', 0, limits({{kNoJoint, 1}, {kPanId, 1000000}})), CODE_REFUSED, "99");
  for (const int limit : {0, -1}) {
    expectRefusal(answerTo('V', 0, limits({{kPanId, 1000000}, {kNeckTiltId, limit}})), CODE_REFUSED, "above 0");
    expectRefusal(answerTo('V', 0, limits({{kNeckTiltId, limit}, {kPanId, 1000000}})), CODE_REFUSED, "above 0");
  }
  EXPECT_THAT(limitsIn(answerTo('V', 0)), ::testing::Contains(std::make_pair(kPanId, 10057460)));
}

// --------------------------------------------------------------------------------------------------------------- T

TEST_F(Version2Test, TelemetryPeriodIsRoundedUpToWhatTheRobotCanMeasure) {
  const std::map<int, int> expected = {{0, 0}, {1, 4}, {4, 4}, {5, 8}, {16, 16}, {65533, 65532}, {65535, 65532}};
  for (const auto& [asked, answered] : expected) {
    const Frame answer = answerTo('T', 0, period(static_cast<unsigned short>(asked)));
    EXPECT_EQ(answer.header.kind, 't');
    EXPECT_EQ(textOf(answer), period(static_cast<unsigned short>(answered))) << asked;
  }
}

TEST_F(Version2Test, TelemetryComesAtItsPeriodWithAllJoints) {
  for (const unsigned frames : {4U, 12U}) {
    answerTo('T', 0, period(static_cast<unsigned short>(frames)));
    passFrames(120);
    const std::vector<Telemetry> all = telemetry();
    EXPECT_EQ(all.size(), 120 / frames);
    for (size_t i = 1; i < all.size(); ++i) {
      EXPECT_EQ(all[i].frame_number, all[i - 1].frame_number + frames);
    }
    ASSERT_FALSE(all.empty());
    ASSERT_EQ(all.back().count, 18 + robot_.model.number_of_sensors);
    for (size_t i = 0; i < 18; ++i) {
      EXPECT_EQ(all.back().entries[i].group, GROUP_JOINT);
      EXPECT_EQ(all.back().entries[i].id, robot_.model.joints[i].identifier);
      EXPECT_EQ(all.back().entries[i].value, FakeRobot::measured(robot_.joints[i]));
    }
  }
  answerTo('T', 0, period(0));
  passFrames(100);
  EXPECT_TRUE(telemetry().empty());
}

TEST_F(Version2Test, TelemetryHasTheDutyOfAllJointsIfItIsAskedFor) {
  FakeRobot::FakeJoint& pan = robot_.joint("head_pan");
  EXPECT_EQ(answerTo('T', TELEMETRY_WITH_DUTY, period(4)).header.id, TELEMETRY_WITH_DUTY);
  passFrames(4);
  const size_t others = 18 + static_cast<size_t>(robot_.model.number_of_sensors);
  Telemetry measured = telemetry().back();
  ASSERT_EQ(measured.count, others + 18);
  for (size_t i = 0; i < 18; ++i) {
    EXPECT_EQ(measured.entries[others + i].group, GROUP_DUTY);
    EXPECT_EQ(measured.entries[others + i].id, robot_.model.joints[i].identifier);
    EXPECT_NEAR(measured.entries[others + i].value, robot_.joints[i].duty_at_rest / 512.0 * 1e6, 1);
  }
  pan.duty = -384;
  passFrames(4);
  EXPECT_EQ(telemetry().back().entries[others + 1].value, -750000);
  EXPECT_EQ(answerTo('T', TELEMETRY_PLAIN, period(4)).header.id, TELEMETRY_PLAIN);
  passFrames(4);
  EXPECT_EQ(telemetry().back().count, others);
  EXPECT_EQ(answerTo('T', 4, period(4)).header.id, TELEMETRY_PLAIN) << "a bit of the future";
}

TEST_F(Version2Test, TelemetryFollowsTheMotionFrameByFrame) {
  answerTo('T', 0, period(4));
  send(frame('J', 0, 1, targets({{kPanId, 1000000}}, 1000)));
  nextFrame();
  std::vector<Telemetry> all;
  for (int i = 0; i < 50; ++i) {
    passFrames(4);
    const std::vector<Telemetry> read = telemetry();  // what is not read in time is replaced
    all.insert(all.end(), read.begin(), read.end());
  }
  ASSERT_GT(all.size(), 40U);
  for (const Telemetry& measured : all) {
    const FakeRobot::FakeJoint& pan = robot_.joint("head_pan");
    EXPECT_EQ(measured.entries[1].value, pan.path[measured.frame_number - FakeRobot::kFirstFrame] + pan.error);
  }
}

TEST_F(Version2Test, ClientThatDoesNotReadGetsOnlyTheNewestTelemetry) {
  disconnect();
  robot_.showNoise();
  client_ = connect(4096);
  send(request('X', 2) + frame('T', 0, 1, period(4)) + frame('W', 100, 2, stream(true)));
  for (int i = 0; i < 200; ++i) {
    send(frame('H', 0, 3));
    takeImage();
  }
  ASSERT_TRUE(await(*client_));
  int late = 0;
  while (const std::optional<Frame> next = client_->nextFrame()) {
    late += next->header.kind == TELEMETRY_PUSH && next->header.request_number == 0 ? 1 : 0;
    machine_->runPending();
  }
  EXPECT_LT(late, 20);
}

TEST_F(Version2Test, TelemetryWithANewPeriodBeginsAtOnce) {
  answerTo('T', 0, period(4));
  passFrames(8);
  telemetry();
  answerTo('T', 0, period(400));
  passFrames(4);
  EXPECT_EQ(telemetry().size(), 1U);
}

TEST_F(Version2Test, NoTelemetryFollowsTheAnswerThatEndsIt) {
  connectBehindAPicture();
  send(frame('T', 0, 1, period(4)));
  passFrames(4);
  send(frame('T', 0, 2, period(0)));
  std::optional<Frame> next = nextFrame();
  while (next && next->header.request_number != 2) {
    next = nextFrame();
  }
  EXPECT_TRUE(telemetry().empty());
}

// --------------------------------------------------------------------------------------------------------------- O

TEST_F(Version2Test, MotorsAreOnFromTheStartAndSwitchedOffAndOn) {
  EXPECT_TRUE(motorsAfter(""));
  EXPECT_TRUE(motorsAfter("\1")) << "they are on already";
  EXPECT_FALSE(motorsAfter(std::string(1, '\0')));
  EXPECT_FALSE(motorsAfter(std::string(1, '\0'))) << "they are off already";
  EXPECT_FALSE(motorsAfter(""));
  EXPECT_THAT(robot_.joints, Each(Field(&FakeRobot::FakeJoint::gain, false)));
  EXPECT_TRUE(motorsAfter("\1"));
  passFrames(kUntilMeasured);
  for (const FakeRobot::FakeJoint& joint : robot_.joints) {
    EXPECT_TRUE(joint.gain);
    EXPECT_NE(joint.gains.proportional, 0);
  }
  answerTo('J', 0, targets({{kPanId, 1000000}}));
  passFrames(kLongestCommand);
  EXPECT_EQ(positionOf("head_pan"), 1000000);
}

TEST_F(Version2Test, JointThatGetsNoGainIsNamed) {
  motorsAfter(std::string(1, '\0'));
  robot_.joint("mouth").refuses_gains = true;
  motorsAfter("\1");
  passFrames(kUntilMeasured);
  const std::optional<Frame> pushed = nextFrame();
  ASSERT_TRUE(pushed);
  expectRefusal(*pushed, CODE_JOINT_FAULT, "mouth is limp: its motor got no gain");
}

TEST_F(Version2Test, JointsMovedByHandStayThereWhenTheMotorsGoOn) {
  answerTo('J', 0, targets({{kPanId, 1000000}}));
  passFrames(10);
  motorsAfter(std::string(1, '\0'));
  passFrames(kUntilMeasured);
  for (FakeRobot::FakeJoint& joint : robot_.joints) {
    joint.position += 30000;
  }
  passFrames(100);
  const std::vector<int> bent = positions();
  motorsAfter("\1");
  passFrames(kLongestCommand);
  EXPECT_EQ(positions(), bent);
}

TEST_F(Version2Test, JointsAreNotCommandedWhileTheMotorsAreOff) {
  const std::vector<int> before = positions();
  motorsAfter(std::string(1, '\0'));
  expectRefusal(answerTo('J', 0, targets({{kPanId, 1000000}})), CODE_REFUSED, "motors are off");
  motorsAfter("\1");
  passFrames(kLongestCommand);
  EXPECT_EQ(positions(), before);
}

TEST_F(Version2Test, TargetSetWhileTheMotorsAreGoingOnIsReachedWithoutAJump) {
  motorsAfter(std::string(1, '\0'));
  passFrames(kUntilMeasured);
  std::vector<int>& path = robot_.joint("head_pan").path;
  path.clear();
  send(frame('O', 0, 1001, "\1") + frame('J', 0, 1002, targets({{kPanId, 1000000}})));
  passFrames(kLongestCommand);
  EXPECT_EQ(path.back(), 1000000);
  for (size_t i = 1; i < path.size(); ++i) {
    ASSERT_LE(std::abs(path[i] - path[i - 1]), 10057460 / 125);
  }
  EXPECT_EQ(robot_.joint("head_pan").error_when_gain_went_on, 0);
}

TEST_F(Version2Test, MotorsStayAsTheyAreForTheNextClient) {
  motorsAfter(std::string(1, '\0'));
  reconnect();
  EXPECT_FALSE(motorsAfter(""));
}

// ---------------------------------------------------------------------------------------------------------------- I

class HoldTest : public Version2Test {
 protected:
  // Head and tail are under way for a while yet.
  void SetUp() override {
    Version2Test::SetUp();
    answerTo('J', 0, targets({{kPanId, 1500000}, {kTailPanId, -700000}}, 4000));
    passFrames(200);
  }

  bool moves(const std::string& joint) {
    passFrames(40);  // it brakes, and two command vectors are on their way
    const int before = positionOf(joint);
    passFrames(40);
    return positionOf(joint) != before;
  }
};

TEST_F(HoldTest, EverythingStopsWithinAMomentAndNothingTurnsBack) {
  const int before = positionOf("head_pan");
  ASSERT_GT(before, 100000);
  EXPECT_EQ(answerTo('I', HOLD_EVERYTHING).header.kind, 'i');
  EXPECT_FALSE(moves("head_pan"));
  EXPECT_FALSE(moves("tail_pan"));
  EXPECT_LT(positionOf("head_pan"), before + 100000);
  const std::vector<int>& path = robot_.joint("head_pan").path;
  EXPECT_TRUE(std::is_sorted(path.begin(), path.end()));
  answerTo('J', 0, targets({{kPanId, 0}}));
  passFrames(200);
  EXPECT_EQ(positionOf("head_pan"), 0) << "it can be commanded again";
}

TEST_F(HoldTest, TheJointsNamedStopAndTheOthersGoOn) {
  EXPECT_EQ(answerTo('I', HOLD_JOINTS, {1, 21, static_cast<char>(kPanId)}).header.kind, 'i');
  EXPECT_FALSE(moves("head_pan"));
  EXPECT_TRUE(moves("tail_pan"));
  passFrames(kLongestCommand);
  EXPECT_EQ(positionOf("tail_pan"), -700000);
}

TEST_F(HoldTest, WhatCannotBeHeldIsRefusedAndEverythingGoesOn) {
  expectRefusal(answerTo('I', HOLD_JOINTS, {static_cast<char>(kPanId), static_cast<char>(kNoJoint)}), CODE_REFUSED,
                "this robot has no joint 99, so the whole request was refused");
  expectRefusal(answerTo('I', HOLD_JOINTS, {static_cast<char>(kNoJoint), static_cast<char>(kPanId)}), CODE_REFUSED,
                "99");
  expectRefusal(answerTo('I', HOLD_JOINTS), CODE_REFUSED, "bad request: no joint is named");
  expectRefusal(answerTo('I', HOLD_EVERYTHING, "\2"), CODE_REFUSED, "bad request: the payload");
  expectRefusal(answerTo('I', 2), CODE_REFUSED, "bad request: the id is neither 0");
  EXPECT_TRUE(moves("head_pan"));
}

TEST_F(HoldTest, WithTheMotorsOffThereIsNothingToStop) {
  EXPECT_FALSE(motorsAfter(std::string(1, '\0')));
  EXPECT_EQ(answerTo('I', HOLD_EVERYTHING).header.kind, 'i');
}

// -------------------------------------------------------------------------------------------------------------- jam

constexpr unsigned char kTailTiltId = 52;  // the last one

class JamTest : public Version2Test {
 protected:
  void SetUp() override {
    Version2Test::SetUp();
    robot_.joint("tail_tilt").jammed = true;
    command(1000000);
    EXPECT_THAT(pushed(), ElementsAre(HasSubstr("e tail_tilt is jammed")));
  }

  void command(int position, unsigned char joint = kTailTiltId) {
    live();
    answerTo('J', 0, targets({{joint, position}}));
    passFrames(4 * JointWatch::PATIENCE);
  }

  // What was pushed.
  std::vector<std::string> pushed() {
    std::vector<std::string> all;
    while (const std::optional<Frame> next = client_->nextFrame()) {
      EXPECT_EQ(next->header.request_number, 0);
      const std::string payload = textOf(*next);
      if (next->header.kind == MOTORS_AND_POSTURE_PUSH) {
        continue;
      }
      all.push_back(next->header.kind == 'e' ? "e " + payload.substr(2)
                                             : "i" + std::to_string(payload.at(0)) + std::to_string(payload.at(1)) +
                                                   " " + payload.substr(4));
    }
    return all;
  }
};

TEST_F(JamTest, IsOverOnceTheJointFollowsItsCommandsAgain) {
  robot_.joint("tail_tilt").jammed = false;
  passFrames(4 * JointWatch::PATIENCE);
  EXPECT_THAT(pushed(), ElementsAre()) << "nobody knows before it is commanded";
  command(500000);
  EXPECT_THAT(pushed(), ElementsAre("i40 tail_tilt\nit follows its commands again"));
  command(200000);
  EXPECT_THAT(pushed(), ElementsAre());
  for (const bool jammed : {true, false}) {
    robot_.joint("neck_tilt").jammed = jammed;
    command(-500000, kNeckTiltId);
    EXPECT_THAT(pushed(), ElementsAre(HasSubstr(jammed ? "e neck_tilt is jammed" : "i40 neck_tilt\n")));
  }
}

TEST_F(JamTest, IsReportedAgainWhileItLasts) {
  command(500000);
  EXPECT_THAT(pushed(), ElementsAre(HasSubstr("e tail_tilt is jammed")));
}

TEST_F(JamTest, IsNotOverBecauseTheMotorsAreSwitchedOffTheJointIsMovedByHandAndTheyAreOnAgain) {
  live();
  EXPECT_FALSE(motorsAfter(std::string(1, '\0')));
  robot_.joint("tail_tilt").position += 400000;
  EXPECT_TRUE(motorsAfter("\1"));
  passFrames(4 * JointWatch::PATIENCE);
  EXPECT_THAT(pushed(), ElementsAre());
}

TEST_F(JamTest, AndItsEndAreToldLaterIfThereIsNoRoom) {
  disconnect();
  robot_.showNoise();
  connectVersion2(4096);
  for (const bool jammed : {true, false}) {
    robot_.joint("tail_tilt").jammed = jammed;
    live();
    std::string requests = frame('J', 0, 1, targets({{kTailTiltId, jammed ? 500000 : 200000}}));
    for (int i = 0; i < 300; ++i) {
      requests += frame('V', 0, 2);
    }
    send(frame('F', 100, 3, kLayerHigh));  // everything waits behind this picture
    takeImage();
    sendAll(requests + frame('H', 0, 4));
    passFrames(4 * JointWatch::PATIENCE);
    std::vector<std::string> told;
    for (std::optional<Frame> next = nextFrame(); next && next->header.request_number != 4; next = nextFrame()) {
      if (next->header.request_number == 0) {
        told.push_back(textOf(*next));
      }
    }
    EXPECT_THAT(told, ElementsAre(HasSubstr(jammed ? "tail_tilt is jammed" : "tail_tilt\nit follows")));
  }
}

TEST_F(Version2Test, JointWhoseGainWentOffIsReportedAsNotFollowing) {
  robot_.joint("head_pan").gain = false;
  robot_.joint("head_pan").duty = 0;
  answerTo('J', 0, targets({{kPanId, 1000000}}));
  passFrames(kLongestCommand);
  const std::optional<Frame> pushed = client_->nextFrame();
  ASSERT_TRUE(pushed);
  expectRefusal(*pushed, CODE_JOINT_FAULT, "head_pan does not follow");
}

// ----------------------------------------------------------------------------------------------------- bad requests

TEST_F(Version2Test, UnknownRequestsAreNotSupported) {
  for (int kind = 0; kind < 256; ++kind) {
    if (std::string("HFWJVTOILKGZBXPNASEUDMYQR").find(static_cast<char>(kind)) == std::string::npos) {
      expectRefusal(answerTo(static_cast<char>(kind), 1, "abc"), CODE_NOT_SUPPORTED,
                    "H F W J V T O I L K G Z B X P N A S E");
    }
  }
  EXPECT_STREQ(hello().robot, "ERS-7");
}

TEST_F(Version2Test, MalformedRequestsAreRefusedAndTheConnectionGoesOn) {
  const std::vector<std::pair<char, std::string>> malformed = {{'F', ""},    {'F', "\4"},  {'W', "abc"},  {'J', "abc"},
                                                               {'V', "abc"}, {'T', "abc"}, {'O', "\2"},   {'O', "ab"},
                                                               {'L', "abc"}, {'K', "\1"},  {'K', "\1\2"}, {'N', "a"}};
  answerTo('W', 85, kStreamOn);
  answerTo('T', 0, std::string("\0\4", 2));
  for (const auto& [kind, payload] : malformed) {
    expectRefusal(answerTo(kind, 0, payload), CODE_REFUSED, "bad request");
  }
  expectRefusal(answerTo('J', 0, targets({{kPanId, 1}, {kPanId, 2}})), CODE_REFUSED, "twice");
  EXPECT_STREQ(hello().robot, "ERS-7");
  passFrames(8);
  std::string pushed;
  while (const std::optional<Frame> next = client_->nextFrame()) {
    pushed += next->header.kind;
  }
  EXPECT_THAT(pushed, AllOf(HasSubstr("f"), HasSubstr("t"))) << "nothing of it has ended the stream or telemetry";
}

TEST_F(Version2Test, RequestWithoutANumberIsRefused) {
  send(frame('H', 0, 0));
  const std::optional<Frame> answer = nextFrame();
  ASSERT_TRUE(answer);
  expectRefusal(*answer, CODE_REFUSED, "number");
}

TEST_F(Version2Test, LargestFrameIsAcceptedAndALargerOneEndsTheConnectionWithAReason) {
  const std::string largest = frame('C', 0, 41, std::string(MAX_PAYLOAD_TOWARDS_ROBOT, 'z'));
  sendAll(largest);
  const std::optional<Frame> not_supported = nextFrame();
  ASSERT_TRUE(not_supported);
  expectRefusal(*not_supported, CODE_NOT_SUPPORTED, "not supported");
  FrameHeader header = {'C', 0, 42, MAX_PAYLOAD_TOWARDS_ROBOT + 1};
  std::string too_large(FRAME_HEADER_SIZE, '\0');
  encode(header, reinterpret_cast<unsigned char*>(too_large.data()));
  send(too_large);
  const std::optional<Frame> answer = nextFrame();
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->header.request_number, 42);
  expectRefusal(*answer, CODE_REFUSED, "too large");
  EXPECT_TRUE(awaitEnd(*client_));
  connectVersion2();
  EXPECT_STREQ(hello().robot, "ERS-7");
}

}  // namespace
