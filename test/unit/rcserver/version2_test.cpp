// Version 2 of the protocol.

#include <tuple>

#include "picture_checks.h"
#include "rcserver/joints/JointControl.h"
#include "rcserver_fixture.h"

namespace {

using namespace protocol::version2;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr unsigned char kPanId = 2;
constexpr unsigned char kTailPanId = 51;

constexpr unsigned kLongestCommand = 500;
constexpr size_t kWalkValues = 5;  // in telemetry

class Version2Test : public Version2Fixture {
 protected:
  bool motorsAfter(const std::string& payload) {
    const Frame answer = answerTo('O', 0, payload.empty() ? payload : order(payload));
    EXPECT_EQ(answer.header.kind, 'o');
    return payloadIn<MotorState>(answer).on;
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
    for (const Frame& next : arrived()) {
      EXPECT_EQ(next.header.kind, TELEMETRY_PUSH);
      EXPECT_EQ(next.header.request_number, 0);
      all.push_back(payloadIn<Telemetry>(next));
    }
    return all;
  }

  int positionOf(const std::string& joint) { return robot_.joint(joint).position; }
};

TEST_F(Version2Test, BytesAfterTheRequestForVersion2BelongToIt) {
  const std::string bytes = request('F', 85) + request('X', 2) + frame('H', 0, 7) + frame('O', 0, 8);
  for (size_t first_piece = 1; first_piece < bytes.size(); ++first_piece) {
    disconnect();
    client_ = connect();
    send(bytes.substr(0, first_piece));
    send(bytes.substr(first_piece));
    const std::optional<Reply> reply = await(*client_);
    ASSERT_TRUE(reply && agreesToVersion2(reply->value)) << first_piece;
    EXPECT_EQ(nextFrame()->header.kind, 'h') << first_piece;
    EXPECT_EQ(nextFrame()->header.kind, 'o') << first_piece;
  }
}

TEST_F(Version2Test, TheNextClientGetsNothingOfTheLastOne) {
  connectBehindAPicture();
  send(frame('T', 0, 1, payloadOf(TelemetryPeriod{4})) + frame('H', 0, 2) + frame('H', 0, 3).substr(0, 5));
  reconnect();
  passFrames(12);
  EXPECT_THAT(heard(), IsEmpty());
  EXPECT_EQ(answerTo('H', 0).header.kind, 'h') << "the beginning of a request is forgotten";
}

TEST_F(Version2Test, HelloHasTheRobotTheTimeAndItsLimits) {
  const Hello said = hello();
  EXPECT_STREQ(said.robot, "ERS-7");
  EXPECT_THAT(said.server, HasSubstr("aibo_rcserver"));
  EXPECT_NEAR(said.frame_number, clock_.frame(), 4);
  ASSERT_EQ(said.joint_count, robot_.model.number_of_joints);
  for (int i = 0; i < said.joint_count; ++i) {
    EXPECT_EQ(said.joints[i].id, robot_.model.joints[i].identifier);
    EXPECT_EQ(said.joints[i].lower, robot_.model.joints[i].lowest);
    EXPECT_EQ(said.joints[i].upper, robot_.model.joints[i].highest);
    EXPECT_EQ(said.joints[i].speed, robot_.model.joints[i].highest_speed);
  }
  EXPECT_DOUBLE_EQ(said.walk.forward, 0.3);
  EXPECT_DOUBLE_EQ(said.walk.back, 0.15);
  EXPECT_DOUBLE_EQ(said.walk.left, 0.08);
  EXPECT_DOUBLE_EQ(said.walk.turn, 1.5);
  EXPECT_EQ(answerTo('H', 0, "abc").header.kind, 'h') << "a payload is ignored";
}

TEST_F(Version2Test, ClientSilentForFiveSecondsIsDroppedAndItsJointsHold) {
  answerTo('T', 0, payloadOf(TelemetryPeriod{4}));  // a client that only reads is silent
  for (int second = 0; second < 20; ++second) {
    hello();
    passFrames(125);
  }
  send(frame('J', 0, 1, order(targetsOf({{kPanId, 1000000}}, 60000))));
  passFrames(620);
  EXPECT_FALSE(client_->ended());
  passFrames(9);
  EXPECT_TRUE(awaitEnd(*client_));
  EXPECT_THAT(console_.str(), HasSubstr("silent for 5 s"));
  passFrames(100);
  EXPECT_FALSE(moves("head_pan"));
}

// Requests: OPENR/OPrimitiveControl.h.
TEST_F(Version2Test, CameraSettingsGoToTheCameraAndAreInForceUntilTheClientGoes) {
  using Request = std::pair<OPrimitiveRequest, longword>;
  const struct {
    int id;
    char at_first;
    char wanted;
    Request set;
    Request set_back;
  } rows[] = {{SETTING_WHITE_BALANCE, 3, 1, {384, 1}, {384, 3}},
              {SETTING_GAIN, 2, 3, {385, 3}, {385, 2}},
              {SETTING_SHUTTER_SPEED, 2, 1, {386, 1}, {386, 2}},
              {SETTING_AUTO_EXPOSURE, 0, 1, {388, 0}, {389, 0}},
              {SETTING_AUTO_WHITE_BALANCE, 0, 1, {390, 0}, {391, 0}}};
  for (const auto& row : rows) {
    robot_.camera_requests.clear();
    EXPECT_EQ(textOf(answerTo('G', row.id)), std::string(1, row.at_first));
    EXPECT_THAT(robot_.camera_requests, ElementsAre()) << "reading leaves the camera alone";
    EXPECT_EQ(textOf(answerTo('G', row.id, std::string(1, row.wanted))), std::string(1, row.wanted));
    EXPECT_EQ(textOf(answerTo('G', row.id)), std::string(1, row.wanted));
    EXPECT_THAT(robot_.camera_requests, ElementsAre(row.set));
    reconnect();
    EXPECT_THAT(robot_.camera_requests, ElementsAre(row.set, row.set_back));
    EXPECT_EQ(textOf(answerTo('G', row.id)), std::string(1, row.at_first));
  }
}

TEST_F(Version2Test, CameraSettingThatTheCameraRefusesIsToldAndNotInForce) {
  robot_.refuses_camera_settings = true;
  expectRefusal(answerTo('G', SETTING_GAIN, "\3"), CODE_REFUSED, "console");
  EXPECT_THAT(console_.str(), HasSubstr("does not take the value 3 of its setting 2"));
  EXPECT_EQ(textOf(answerTo('G', SETTING_GAIN)), "\2");
}

TEST_F(Version2Test, PicturesTellTheCamerasSettings) {
  answerTo('W', 85, kStreamOn);
  takeImage();
  EXPECT_THAT(nextPicture().image.settings.values, ElementsAre(3, 2, 2, 0, 0));
  answerTo('G', SETTING_SHUTTER_SPEED, "\x03");
  takeImage();
  EXPECT_THAT(nextPicture().image.settings.values, ElementsAre(3, 2, 3, 0, 0));
}

TEST_F(Version2Test, EachPictureRequestGetsItsOwnPictureEvenDuringAStream) {
  answerTo('W', 80, kStreamOn);
  send(frame('F', 20, 1001, kLayerHigh) + frame('F', 30, 1002, kLayerHigh));
  const std::vector<std::pair<int, int>> expected = {{1001, 20}, {1002, 30}, {0, 80}, {0, 80}};
  for (const auto& [number, quality] : expected) {
    takeImage();
    const Picture picture = nextPicture();
    EXPECT_EQ(picture.frame.request_number, number);
    EXPECT_EQ(picture.frame.id, quality);
    EXPECT_EQ(picture.image.quality, quality);
    EXPECT_EQ(picture.image.image_count, robot_.lastImage());
    EXPECT_EQ(picture.image.frame_number, clock_.frame());
    EXPECT_EQ(quantizerOf(picture.jpeg), quantizerFor(quality));
    EXPECT_NEAR(decodeJpeg(picture.jpeg).level(), FakeRobot::brightness(robot_.lastImage()), 3);
  }
}

TEST_F(Version2Test, PicturesOfAllLayersHaveTheirSizes) {
  robot_.detail = {128, 128, 128};
  takeImage();
  const std::tuple<Layer, int, int> rows[] = {
      {LAYER_HIGH, 208, 160}, {LAYER_MIDDLE, 104, 80}, {LAYER_LOW, 52, 40}, {LAYER_DOUBLE, 416, 320}};
  for (const auto& [layer, width, height] : rows) {
    send(frame('F', 85, 5, payloadOf(PictureRequest{layer})));
    takeImage();
    const Picture picture = nextPicture();
    const Decoded shown = decodeJpeg(picture.jpeg);
    EXPECT_EQ(picture.image.layer, layer);
    EXPECT_EQ(picture.image.width, width);
    EXPECT_EQ(picture.image.height, height);
    EXPECT_EQ(shown.width, width);
    EXPECT_EQ(shown.height, height);
    EXPECT_NEAR(shown.level(), FakeRobot::brightness(robot_.lastImage()), 3);
  }
}

TEST_F(Version2Test, StreamHasEveryNthImageFromTheAnswerOn) {
  answerTo('W', 85, payloadOf(StreamSettings{true, LAYER_HIGH, 3}));
  takeImage();
  const unsigned first = nextPicture().image.image_count;
  for (int i = 1; i < 3; ++i) {
    passFrames(3 * FakeRobot::kFramesPerImage);
    EXPECT_EQ(nextPicture().image.image_count, first + 3 * i);
  }
  answerTo('W', 20, payloadOf(StreamSettings{true, LAYER_LOW, 1}));
  takeImage();
  const Picture other = nextPicture();
  EXPECT_EQ(other.image.quality, 20);
  EXPECT_EQ(other.image.layer, LAYER_LOW);
  answerTo('W', 85, kStreamOff);
  passFrames(3 * FakeRobot::kFramesPerImage);
  EXPECT_FALSE(client_->nextFrame());
}

TEST_F(Version2Test, PictureThatIsTooLargeForAFrameHasALowerQuality) {
  robot_.detail = {128, 128, 128};
  robot_.showNoise();
  takeImage();
  send(frame('F', 100, 5, payloadOf(PictureRequest{LAYER_DOUBLE})));
  takeImage();
  const Picture picture = nextPicture();
  EXPECT_EQ(picture.image.quality, 25);
  EXPECT_EQ(picture.frame.id, 25);
  EXPECT_EQ(decodeJpeg(picture.jpeg).width, 416);
  EXPECT_EQ(quantizerOf(picture.jpeg), quantizerFor(25));
}

TEST_F(Version2Test, SpeedLimitsOfAllJointsAreRead) {
  answerTo('V', 0, payloadOf(SpeedLimits{2, {{kPanId, 1000000}, {kTailPanId, 700001}}}));
  const auto all = payloadIn<SpeedLimits>(answerTo('V', 0));
  ASSERT_EQ(all.count, 18);
  for (size_t i = 0; i < all.count; ++i) {
    const int id = all.joints[i].id;
    const int usual = robot_.model.joints[i].highest_speed;
    EXPECT_EQ(all.joints[i].value, id == kPanId ? 1000000 : id == kTailPanId ? 700001 : usual) << id;
  }
}

TEST_F(Version2Test, TelemetryComesAtItsPeriodWithAllJoints) {
  for (const std::uint16_t frames : {std::uint16_t{4}, std::uint16_t{12}}) {
    answerTo('T', 0, payloadOf(TelemetryPeriod{frames}));
    passFrames(120);
    const std::vector<Telemetry> all = telemetry();
    EXPECT_EQ(all.size(), 120 / frames);
    for (size_t i = 1; i < all.size(); ++i) {
      EXPECT_EQ(all[i].frame_number, all[i - 1].frame_number + frames);
    }
    ASSERT_FALSE(all.empty());
    ASSERT_EQ(all.back().count, 18 + robot_.model.number_of_sensors + kWalkValues);
    for (size_t i = 0; i < 18; ++i) {
      EXPECT_EQ(all.back().entries[i].group, GROUP_JOINT);
      EXPECT_EQ(all.back().entries[i].id, robot_.model.joints[i].identifier);
      EXPECT_EQ(all.back().entries[i].value, FakeRobot::measured(robot_.joints[i]));
    }
  }
  answerTo('T', 0, payloadOf(TelemetryPeriod{0}));
  passFrames(100);
  EXPECT_TRUE(telemetry().empty());
}

TEST_F(Version2Test, TelemetryHasTheDutyOfAllJointsIfItIsAskedFor) {
  FakeRobot::FakeJoint& pan = robot_.joint("head_pan");
  answerTo('T', TELEMETRY_WITH_DUTY, payloadOf(TelemetryPeriod{4}));
  passFrames(4);
  const size_t others = 18 + static_cast<size_t>(robot_.model.number_of_sensors);
  Telemetry measured = telemetry().back();
  ASSERT_EQ(measured.count, others + 18 + kWalkValues);
  for (size_t i = 0; i < 18; ++i) {
    EXPECT_EQ(measured.entries[others + i].group, GROUP_DUTY);
    EXPECT_EQ(measured.entries[others + i].id, robot_.model.joints[i].identifier);
    EXPECT_NEAR(measured.entries[others + i].value, robot_.joints[i].duty_at_rest / 512.0 * 1e6, 1);
  }
  pan.duty = -384;
  passFrames(4);
  EXPECT_EQ(telemetry().back().entries[others + 1].value, -750000);
}

TEST_F(Version2Test, ClientThatReadsLateGetsOnlyTheNewestTelemetry) {
  connectBehindAPicture();
  send(frame('T', 0, 1, payloadOf(TelemetryPeriod{4})));
  passFrames(80);
  EXPECT_NEAR(payloadIn<Telemetry>(nextPush(TELEMETRY_PUSH)).frame_number, clock_.frame(), 4);
  EXPECT_THAT(telemetry(), IsEmpty());
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
  answerTo('J', 0, order(targetsOf({{kPanId, 1000000}})));
  passFrames(10);
  motorsAfter(std::string(1, '\0'));
  passFrames(kUntilMeasured);
  for (FakeRobot::FakeJoint& joint : robot_.joints) {
    joint.position += 30000;
  }
  robot_.joint("head_pan").position += 200000;
  passFrames(100);
  const std::vector<int> bent = positions();
  motorsAfter("\1");
  passFrames(kLongestCommand);
  EXPECT_EQ(positions(), bent);
  EXPECT_THAT(arrived('e'), IsEmpty()) << "that they were elsewhere is no fault";
  motorsAfter(std::string(1, '\0'));
  motorsAfter("\1");
  answerTo('J', 0, order(targetsOf({{kPanId, 300000}})));
  passFrames(kLongestCommand);
  EXPECT_EQ(positionOf("head_pan"), 300000) << "a target from before they have power";
}

TEST_F(Version2Test, MotorsStayAsTheyAreForTheNextClient) {
  motorsAfter(std::string(1, '\0'));
  reconnect();
  EXPECT_FALSE(motorsAfter(""));
}

TEST_F(Version2Test, AHoldStopsTheJointsNamedOrAll) {
  const auto moves = [this](const std::string& joint) {
    passFrames(40);  // it brakes, and two command vectors are on their way
    const int before = positionOf(joint);
    passFrames(40);
    return positionOf(joint) != before;
  };
  answerTo('J', 0, order(targetsOf({{kPanId, 1500000}, {kTailPanId, -700000}}, 4000)));
  passFrames(120);
  answerTo('I', HOLD_JOINTS, {1, static_cast<char>(kPanId)});
  EXPECT_FALSE(moves("head_pan"));
  EXPECT_TRUE(moves("tail_pan"));
  answerTo('I', HOLD_EVERYTHING);
  EXPECT_FALSE(moves("tail_pan"));
  const std::vector<int>& path = robot_.joint("head_pan").path;
  EXPECT_TRUE(std::is_sorted(path.begin(), path.end())) << "it turned back";
}

TEST_F(Version2Test, AJammedJointIsReportedAndThatItFollowsAgain) {
  constexpr unsigned char kTailTiltId = 52;  // the last one
  std::vector<std::string> pushed;
  const auto command = [&](int position) {
    answerTo('J', 0, order(targetsOf({{kTailTiltId, position}})));
    passFrames(4 * JointWatch::PATIENCE);
    pushed.clear();
    for (const Frame& next : arrived()) {
      if (next.payload.at(0) != ENDED_JOINTS) {
        pushed.push_back(next.header.kind + textOf(next).substr(next.header.kind == 'e' ? 2 : 0));
      }
    }
  };
  robot_.joint("tail_tilt").jammed = true;
  command(1000000);
  EXPECT_THAT(pushed, ElementsAre(HasSubstr("etail_tilt is jammed")));
  robot_.joint("tail_tilt").jammed = false;
  command(500000);
  EXPECT_THAT(pushed, ElementsAre(std::string("i\4\0\0\0tail_tilt\nit follows its commands again", 44)));
  command(200000);
  EXPECT_THAT(pushed, IsEmpty());
}

}  // namespace
