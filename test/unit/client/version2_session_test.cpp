#include "client/version2_session.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "client/fault.h"
#include "session_fixture.h"
#include "support/version2_frames.h"

using namespace aibo_client;
using std::chrono::milliseconds;
using test_pictures::Bytes;
using testing::HasSubstr;
using version2_frames::makeFrame;

namespace version2 = protocol::version2;

namespace {

class Version2SessionTest : public SessionFixture {
 protected:
  Session& session() override { return session_; }

  void SetUp() override {
    EXPECT_EQ("H1", request());
    receive(makeFrame('h', 1, version2_frames::makeHello("F W J V T", kFrame)));
    EXPECT_TRUE(session_.ready());
  }

  /// What the session sends now: "" or kind and request number, as in "F3". The whole of it is in frame_.
  std::string request() {
    const Bytes bytes = session_.nextRequest(wish_, now_);
    if (bytes.empty()) {
      return "";
    }
    frame_ = version2_frames::split(bytes);
    if (std::string("DHJKLNOUV").find(frame_.header.kind) != std::string::npos) {
      EXPECT_EQ(0, frame_.header.id) << frame_.header.kind;
    }
    return frame_.header.kind + std::to_string(frame_.header.request_number);
  }

  /// Lets time pass, and answers the heartbeat.
  void live(milliseconds time) {
    const TimePoint end = now_ + time;
    while (now_ < end) {
      answerHeartbeat();
      pass(std::min(end, session_.nextDeadline()) - now_);
    }
    answerHeartbeat();
  }

  void answerHeartbeat() {
    for (std::string each = request(); !each.empty(); each = request()) {
      ASSERT_EQ('H', each[0]);
      receive(makeFrame('h', frame_.header.request_number, version2_frames::makeHello()));
    }
  }

  std::string faultOf(const Bytes& bytes) {
    try {
      receive(bytes);
    } catch (const ProtocolException& error) {
      return error.what();
    }
    return "";
  }

  version2_frames::Frame frame_;  // that was sent last
  Version2Session session_{connection_, now_};
};

Bytes makeError(int number, int code, const std::string& text) {
  return makeFrame('e', number, version2_frames::makeError(code, text));
}

Bytes makePicture(int number, unsigned seed, unsigned frame_number = 0) {
  return makeFrame('f', number, version2_frames::makePicture(test_pictures::makeNumbered(seed), frame_number));
}

TEST_F(Version2SessionTest, TheHelloIntroducesTheRobot) {
  const RobotInfo& robot = connection_.robot;
  EXPECT_EQ("ERS-7", robot.design);
  EXPECT_EQ("a test 1.0", robot.server);
  EXPECT_TRUE(robot.hasCapability("J"));
  EXPECT_FALSE(robot.hasCapability("Z"));
  std::string limits;
  for (const JointLimits& joint : robot.joint_limits) {
    for (const double each : {joint.id * 1.0, joint.lower, joint.upper, joint.speed}) {
      limits += std::to_string(std::lround(each * 10)) + " ";
    }
  }
  EXPECT_EQ("10 -13 0 30 20 -15 16 100 ", limits);
}

TEST(Version2SessionBeginTest, NothingIsAskedForBeforeTheHelloIsAnswered) {
  const Notifier notifier{Callbacks()};
  ClientStatistics counters;
  const Session::TimePoint now = Session::TimePoint() + milliseconds(1000);
  Connection connection({"robot:54321", milliseconds(1700), notifier, counters}, now);
  Version2Session session(connection, now);
  const Wish wish = {true, 85, 4};
  EXPECT_FALSE(session.nextRequest(wish, now).empty());
  Call stop = callToHold({});
  stop.deadline = now + milliseconds(5000);
  session.add(std::move(stop));
  EXPECT_TRUE(session.nextRequest(wish, now).empty()) << "not even for a stop";
  EXPECT_FALSE(session.ready());
  EXPECT_NO_THROW(session.checkDeadlines(now + milliseconds(1699))) << "an answer has as much time as a picture";
  EXPECT_THROW(session.checkDeadlines(now + milliseconds(1700)), Fault);
}

TEST_F(Version2SessionTest, AServerThatRefusesTheHelloIsGivenUp) {
  pass(milliseconds(250));
  EXPECT_EQ("H2", request());
  EXPECT_THAT(faultOf(makeError(2, 0, "not now")), HasSubstr("not now"));
}

TEST_F(Version2SessionTest, AHeartbeatIsSentFourTimesASecondWhileNothingElseIs) {
  const TimePoint begin = now_;
  int heartbeats = 0;
  while (now_ < begin + std::chrono::minutes(10)) {
    pass(session_.nextDeadline() - now_);
    if (!request().empty()) {
      ++heartbeats;
      receive(makeFrame('h', frame_.header.request_number, version2_frames::makeHello()));
    }
  }
  EXPECT_NEAR(2400, heartbeats, 1);
}

TEST_F(Version2SessionTest, AServerThatDoesNotAnswerTheHeartbeatIsGivenUpAlsoWhileNothingIsWanted) {
  for (int number = 2; number <= 5; ++number) {
    pass(milliseconds(250));
    EXPECT_EQ("H" + std::to_string(number), request());
  }
  pass(milliseconds(249));
  EXPECT_EQ("robot:54321 did not answer the request 'H' within 1000 ms", whyGivenUpWithin(milliseconds(1)));
}

TEST_F(Version2SessionTest, TheStreamIsRequestedOnceForEachChangeOfWishOrQuality) {
  wish_.streaming = true;
  EXPECT_EQ("W2", request());
  EXPECT_EQ(73, frame_.header.id);
  EXPECT_EQ(Bytes({1, 0, 0, 1}), frame_.payload);
  EXPECT_EQ("", request());
  for (const int quality : {40, 90}) {
    wish_.jpeg_quality = quality;
    EXPECT_EQ('W', request()[0]);
    EXPECT_EQ(quality, frame_.header.id);
    EXPECT_EQ("", request());
  }
  EXPECT_TRUE(connection_.pictures.streaming());
  wish_.streaming = false;
  EXPECT_EQ("W5", request());
  EXPECT_EQ(Bytes({0, 0, 0, 1}), frame_.payload);
  EXPECT_FALSE(connection_.pictures.streaming());
  wish_.jpeg_quality = 50;
  EXPECT_EQ("", request());
}

TEST_F(Version2SessionTest, APictureOfTheStreamHasItsNumbers) {
  wish_.streaming = true;
  request();
  receive(makePicture(0, 1, 4711));
  ASSERT_EQ(1u, pictures_.size());
  EXPECT_EQ(test_pictures::makeNumbered(1), pictures_[0]->jpeg);
  EXPECT_EQ(4711u, pictures_[0]->frame_number);
  EXPECT_EQ(version2_frames::kImageCount, pictures_[0]->image_count);
  EXPECT_EQ(208, pictures_[0]->width);
}

TEST_F(Version2SessionTest, AStreamThatIsSilentIsGivenUpThoughTheHeartbeatIsAnswered) {
  now_ += milliseconds(600);  // a stream that begins late has as much time
  wish_.streaming = true;
  request();
  EXPECT_EQ("W3", request());
  receive(makeFrame('h', 2, version2_frames::makeHello()));
  receive(makeFrame('w', 3, {1, 0, 0, 1}));
  live(milliseconds(499));
  EXPECT_EQ(kSilentStream, whyGivenUp([this] { live(milliseconds(1)); }));
}

TEST_F(Version2SessionTest, SilenceCountsFromTheLastPicture) {
  wish_.streaming = true;
  EXPECT_EQ("W2", request());
  receive(makeFrame('w', 2, {1, 0, 0, 1}));
  now_ += milliseconds(490);  // nothing has come that would have woken the client
  receive(makePicture(0, 1));
  EXPECT_NO_THROW(live(milliseconds(499)));
  EXPECT_EQ(kSilentStream, whyGivenUp([this] { live(milliseconds(1)); }));
}

TEST_F(Version2SessionTest, APictureMayComeSlowly) {
  wish_.streaming = true;
  EXPECT_EQ("W2", request());
  receive(makeFrame('w', 2, {1, 0, 0, 1}));
  const Bytes picture = makePicture(0, 1);
  const auto part = static_cast<std::ptrdiff_t>(picture.size() / 4);
  for (std::ptrdiff_t begin = 0; begin < 4 * part; begin += part) {
    now_ += milliseconds(400);
    receive(Bytes(picture.begin() + begin, begin == 3 * part ? picture.end() : picture.begin() + begin + part));
  }
  EXPECT_EQ(1u, counters_.pictures + counters_.stale_pictures);
}

TEST_F(Version2SessionTest, FramesAreReadHoweverTheirBytesAreSplit) {
  wish_.streaming = true;
  request();
  Bytes bytes = makeFrame('w', 2, {1, 0, 0, 1});
  for (unsigned number = 1; number <= 3; ++number) {
    const Bytes picture = makePicture(0, number, number);
    bytes.insert(bytes.end(), picture.begin(), picture.end());
  }
  for (const std::size_t part : {std::size_t{1}, std::size_t{2}, std::size_t{7}, std::size_t{1000}, bytes.size()}) {
    pictures_.clear();
    for (std::size_t at = 0; at < bytes.size(); at += part) {
      receive(Bytes(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                    bytes.begin() + static_cast<std::ptrdiff_t>(std::min(at + part, bytes.size()))));
    }
    ASSERT_EQ(3u, pictures_.size()) << part;
    EXPECT_EQ(test_pictures::makeNumbered(3), pictures_[2]->jpeg);
    wish_.jpeg_quality = wish_.jpeg_quality == 73 ? 40 : 73;  // asks for the stream again
    request();
    bytes[3] = static_cast<std::uint8_t>(frame_.header.request_number);
  }
}

TEST_F(Version2SessionTest, PicturesOfAStoppedStreamAreDroppedAndAFaultIfTheyDoNotEnd) {
  for (const unsigned stops : {1u, 2u}) {
    for (const bool on : {true, false}) {
      wish_.streaming = on;
      request();
      receive(makeFrame('w', frame_.header.request_number, frame_.payload));
    }
    receive(makePicture(0, stops));
    EXPECT_EQ(stops, counters_.unexpected_pictures);
    live(milliseconds(1100));
  }
  EXPECT_TRUE(pictures_.empty());
  EXPECT_THAT(faultOf(makePicture(0, 2)), HasSubstr("it goes on sending pictures"));
}

TEST_F(Version2SessionTest, DuringTheStreamEachCallerGetsItsOwnPictureAtItsOwnQualityInAnyOrder) {
  wish_.streaming = true;
  request();
  receive(makeFrame('w', 2, {1, 0, 0, 1}));
  auto first = takePicture(10);
  auto second = takePicture(0);
  EXPECT_EQ("F3", request());
  EXPECT_EQ(10, frame_.header.id);
  EXPECT_EQ(Bytes({0}), frame_.payload);
  EXPECT_EQ("F4", request());
  EXPECT_EQ(73, frame_.header.id) << "0 is the stream's";
  EXPECT_EQ("", request());
  receive(makePicture(0, 1));
  EXPECT_FALSE(done(first)) << "this was the stream's";
  receive(makePicture(4, 2));
  receive(makePicture(3, 3));
  EXPECT_EQ(test_pictures::makeNumbered(2), second.get().picture->jpeg);
  const Answer got = first.get();
  EXPECT_EQ(test_pictures::makeNumbered(3), got.picture->jpeg);
  EXPECT_EQ(0, got.stream_quality);
  EXPECT_EQ(3u, pictures_.size());
}

TEST_F(Version2SessionTest, ACallThatTimesOutLeavesTheConnectionAloneAndItsLatePictureIsDropped) {
  auto answer = takePicture(10, milliseconds(300));
  EXPECT_EQ("F2", request());
  live(milliseconds(300));
  EXPECT_EQ(CallOutcome::kTimeout, answer.get().outcome);
  receive(makePicture(2, 1));
  EXPECT_TRUE(pictures_.empty());
}

TEST_F(Version2SessionTest, ADamagedAnswerIsRequestedAgainAndNotBlamedForWhatIsMissingAfterAGoodOne) {
  auto first = takePicture(10, milliseconds(100));
  request();
  receive(makeFrame('f', 2, version2_frames::makePicture(Bytes(5000, 7), 1)));
  EXPECT_EQ("F3", request());
  pass(milliseconds(100));
  ASSERT_TRUE(done(first));
  EXPECT_THAT(first.get().problem, HasSubstr("no picture within 100 ms; the last one was damaged: "));
  auto second = takePicture(10);
  EXPECT_EQ("F4", request());
  receive(makeFrame('f', 4, version2_frames::makePicture(Bytes(5000, 7), 1)));
  EXPECT_EQ("F5", request());
  receive(makePicture(5, 1));
  EXPECT_TRUE(done(second));
  auto third = takePicture(10, milliseconds(100));
  EXPECT_EQ("F6", request());
  pass(milliseconds(100));
  ASSERT_TRUE(done(third));
  EXPECT_EQ("no picture within 100 ms.", third.get().problem);
}

TEST_F(Version2SessionTest, AnErrorBelongsToTheRequestWithItsNumber) {
  auto first = takePicture(10);
  auto second = takePicture(20);
  commandJoints({{77, 0.1}});
  request();
  request();
  EXPECT_EQ("J4", request());
  receive(makeError(3, 0, "no more film"));
  EXPECT_FALSE(done(first));
  const Answer refusal = second.get();
  EXPECT_EQ(CallOutcome::kRefused, refusal.outcome);
  EXPECT_EQ("robot:54321 refused to take a picture: no more film.", refusal.problem);
  receive(makeError(4, 0, "there is no joint 77"));
  EXPECT_EQ(1, logged("refused to move joints: there is no joint 77"));
  EXPECT_EQ(2u, counters_.refusals);
  receive(makePicture(2, 1));
  EXPECT_EQ(CallOutcome::kDone, first.get().outcome);
}

TEST_F(Version2SessionTest, ARefusedStreamIsAFault) {
  wish_.streaming = true;
  request();
  EXPECT_THAT(faultOf(makeError(2, 2, "the camera is broken")),
              HasSubstr("refused to stream pictures: the camera is broken"));
}

TEST_F(Version2SessionTest, RefusedTelemetryIsLoggedAndNotAskedForAgain) {
  wish_.telemetry_period = 4;
  EXPECT_EQ("T2", request());
  receive(makeError(2, 2, ""));
  EXPECT_EQ(1, logged("refused to send telemetry: error code 2"));
  live(milliseconds(5000));
}

TEST_F(Version2SessionTest, TelemetryIsReportedInUnitsWithTheRobotsTime) {
  wish_.telemetry_period = 4;
  EXPECT_EQ("T2", request());
  EXPECT_EQ(Bytes({0, 4}), frame_.payload);
  EXPECT_EQ(version2::TELEMETRY_WITH_DUTY, frame_.header.id);
  receive(makeFrame('t', 2, {0, 4}));
  EXPECT_TRUE(telemetry_.empty()) << "that was the period";
  receive(makeFrame('t', 0,
                    version2_frames::makeTelemetry(99, {{'J', 2, -500000},
                                                        {'S', 53, 250000},
                                                        {'S', 14, 1},
                                                        {'S', 5, 80000000},
                                                        {'S', 66, 870000},
                                                        {'S', 200, -1},
                                                        {'J', 52, 1000000},
                                                        {'D', 52, -250000},
                                                        {'D', 77, 1}})));
  ASSERT_EQ(1u, telemetry_.size());
  EXPECT_EQ(99u, telemetry_[0].frame_number);
  ASSERT_EQ(2u, telemetry_[0].joints.size());
  EXPECT_EQ(2, telemetry_[0].joints[0].id);
  EXPECT_DOUBLE_EQ(-0.5, telemetry_[0].joints[0].position);
  EXPECT_FALSE(telemetry_[0].joints[0].duty) << "not sent";
  EXPECT_EQ(52, telemetry_[0].joints[1].id);
  EXPECT_EQ(-0.25, telemetry_[0].joints[1].duty);
  ASSERT_EQ(5u, telemetry_[0].sensors.size());
  EXPECT_EQ(53, telemetry_[0].sensors[0].id);
  EXPECT_DOUBLE_EQ(0.25, telemetry_[0].sensors[0].value) << "range_near, m";
  EXPECT_DOUBLE_EQ(1, telemetry_[0].sensors[1].value) << "paw_left_front, a switch";
  EXPECT_DOUBLE_EQ(80, telemetry_[0].sensors[2].value) << "head_touch, a strength";
  EXPECT_DOUBLE_EQ(0.87, telemetry_[0].sensors[3].value) << "battery";
  EXPECT_DOUBLE_EQ(-1e-6, telemetry_[0].sensors[4].value) << "a sensor of a newer robot";
  wish_.telemetry_period = 0x102;
  EXPECT_EQ("T3", request()) << "another rate";
  EXPECT_EQ(Bytes({1, 2}), frame_.payload);
}

TEST_F(Version2SessionTest, TelemetryAndPicturesHaveTheTimeOfTheirFirstByteAndTheNumberOfTheirConnection) {
  wish_.streaming = true;
  request();
  for (const Bytes& frame : {makeFrame('t', 0, version2_frames::makeTelemetry(1, {})), makePicture(0, 1)}) {
    const TimePoint first_byte_time = now_;
    receive(Bytes(frame.begin(), frame.begin() + 1));
    pass(milliseconds(10));
    receive(Bytes(frame.begin() + 1, frame.end()));
    const bool picture = frame[0] == 'f';
    EXPECT_EQ(first_byte_time, picture ? pictures_.at(0)->first_byte_time : telemetry_.at(0).arrival);
    EXPECT_EQ(3u, picture ? pictures_.at(0)->connection_number : telemetry_.at(0).connection_number);
  }
}

TEST_F(Version2SessionTest, PicturesThatArrivedTogetherHaveDifferentTimes) {
  wish_.streaming = true;
  request();
  Bytes bytes = makePicture(0, 1);
  const Bytes second = makePicture(0, 2);
  bytes.insert(bytes.end(), second.begin(), second.end());
  receive(bytes);
  ASSERT_EQ(2u, pictures_.size());
  EXPECT_EQ(now_, pictures_[0]->first_byte_time);
  EXPECT_LT(pictures_[0]->first_byte_time, pictures_[1]->first_byte_time);
}

// Telemetry of the frames 4, 8, 12 ...
Bytes makeBurst(unsigned count) {
  Bytes bytes;
  for (unsigned i = 1; i <= count; ++i) {
    const Bytes each = makeFrame('t', 0, version2_frames::makeTelemetry(4 * i, {{'J', 1, 1000 * static_cast<int>(i)}}));
    bytes.insert(bytes.end(), each.begin(), each.end());
  }
  return bytes;
}

TEST_F(Version2SessionTest, AllTelemetryOfThoseThatArrivedTogetherIsReportedInOrder) {
  wish_.telemetry_period = 4;
  EXPECT_EQ("T2", request());
  receive(makeFrame('t', 2, {0, 4}));
  receive(makeBurst(64));
  ASSERT_EQ(64u, telemetry_.size());
  for (unsigned i = 1; i <= 64; ++i) {
    EXPECT_EQ(4 * i, telemetry_[i - 1].frame_number);
    EXPECT_DOUBLE_EQ(0.001 * i, telemetry_[i - 1].joints.at(0).position);
  }
  EXPECT_EQ(64u, counters_.telemetry);
  EXPECT_EQ(0u, counters_.dropped_telemetry);
  receive(makeBurst(1));
  EXPECT_EQ(64u, telemetry_.size()) << "each once, and no more than twice as often as asked for";
  pass(milliseconds(32));
  receive(makeBurst(1));
  EXPECT_EQ(65u, telemetry_.size());
  EXPECT_EQ(1u, counters_.thinned_telemetry);
}

TEST_F(Version2SessionTest, MeasurementsThatNobodyAskedForEnd) {
  for (int i = 0; i < 100; ++i) {
    receive(makeFrame('t', 0, version2_frames::makeTelemetry(4, {{'S', 66, 500000}})));
    now_ += milliseconds(1);
  }
  EXPECT_EQ(64u, telemetry_.size());
  EXPECT_EQ(36u, counters_.thinned_telemetry);
}

TEST_F(Version2SessionTest, ImpossibleValuesAreDroppedAndNamed) {
  constexpr int kLargest = std::numeric_limits<int>::max();
  receive(makeFrame('t', 0,
                    version2_frames::makeTelemetry(
                        4, {{'J', 2, kLargest}, {'J', 3, 0}, {'D', 3, kLargest}, {'S', 66, kLargest}, {'S', 67, -1}})));
  ASSERT_EQ(1u, telemetry_.size());
  ASSERT_EQ(1u, telemetry_[0].joints.size());
  EXPECT_EQ(3, telemetry_[0].joints[0].id);
  EXPECT_FALSE(telemetry_[0].joints[0].duty);
  ASSERT_EQ(1u, telemetry_[0].sensors.size());
  EXPECT_EQ(67, telemetry_[0].sensors[0].id);
  EXPECT_EQ(3u, counters_.impossible_values);
  EXPECT_EQ(1, logged("robot:54321 sent an impossible value, which is dropped: the position of head_pan is 2147.48;"));
  EXPECT_EQ(1, logged("battery is 2147.48;"));
}

TEST_F(Version2SessionTest, OfMoreTelemetryThanThatTheNewestIsReportedAndTheRestIsCounted) {
  receive(makeBurst(70));
  ASSERT_EQ(64u, telemetry_.size());
  EXPECT_EQ(28u, telemetry_.front().frame_number);
  EXPECT_EQ(280u, telemetry_.back().frame_number);
  EXPECT_EQ(64u, counters_.telemetry);
  EXPECT_EQ(6u, counters_.dropped_telemetry);
}

TEST_F(Version2SessionTest, JointsCommandedTogetherAreSentInOneRequest) {
  commandJoints({{2, -0.5}, {3, 0.25}}, milliseconds(300));
  EXPECT_EQ("J2", request());
  version2::JointTargets targets;
  ASSERT_EQ(nullptr, version2::decode(frame_.payload.data(), frame_.payload.size(), &targets));
  EXPECT_EQ(300, targets.duration_ms);
  ASSERT_EQ(2, targets.count);
  EXPECT_EQ(-500000, targets.joints[0].value);
  EXPECT_EQ(3, targets.joints[1].id);
  targets.joints[1].value = 200000;
  receive(makeFrame('j', 2, encoded(targets)));
  EXPECT_THAT(accepted_, testing::ElementsAre("2=-0.500000 3=0.200000 ")) << "as the robot accepted it";
}

TEST_F(Version2SessionTest, NoMoreThanFourCommandsAreUnderWayAndThenTheLatestIsNext) {
  for (int i = 0; i < 4; ++i) {
    commandJoints({{2, 0.1 * i}});
    EXPECT_EQ("J" + std::to_string(i + 2), request());
  }
  for (int i = 4; i < 100; ++i) {
    commandJoints({{2, 0.01 * i}});
    EXPECT_EQ("", request());
  }
  receive(makeFrame('j', 2, {0, 0, 0, 0}));
  EXPECT_EQ("J6", request());
  version2::JointTargets targets;
  ASSERT_EQ(nullptr, version2::decode(frame_.payload.data(), frame_.payload.size(), &targets));
  EXPECT_EQ(990000, targets.joints[0].value);
  receive(makeFrame('j', 3, {0, 0, 0, 0}));
  EXPECT_EQ("", request());
  limitSpeed({{2, 1.0}});
  EXPECT_EQ("V7", request());
  commandJoints({{2, 0.1}});
  EXPECT_EQ("", request()) << "limits of their speed count, too";
}

TEST_F(Version2SessionTest, CommandsThatHadToWaitForLongAreDroppedAndFreshOnesAreSent) {
  for (int i = 0; i < 4; ++i) {
    commandJoints({{2, 0.1 * i}});
    EXPECT_EQ("J" + std::to_string(i + 2), request());
  }
  commandJoints({{2, 0.9}, {3, 0.9}});
  live(milliseconds(490));
  EXPECT_EQ("", request());
  pass(milliseconds(9));
  commandJoints({{3, 0.3}});
  pass(milliseconds(1));
  EXPECT_EQ("H7", request());
  receive(makeFrame('h', 7, version2_frames::makeHello()));
  pass(milliseconds(10));
  receive(makeFrame('j', 2, {0, 0, 0, 0}));
  EXPECT_EQ("J8", request());
  version2::JointTargets targets;
  ASSERT_EQ(nullptr, version2::decode(frame_.payload.data(), frame_.payload.size(), &targets));
  ASSERT_EQ(1, targets.count);
  EXPECT_EQ(3, targets.joints[0].id);
  EXPECT_EQ("", request());
  EXPECT_EQ(1, logged("A joint command was dropped: too old: it could not be sent to robot:54321 in time"));
}

TEST_F(Version2SessionTest, MotorsAndMotionsDropTheJointCommandsThatAreQueuedBeforeThem) {
  for (const char letter : {'O', 'P'}) {
    commandJoints({{2, 0.5}});
    limitSpeed({{2, letter == 'O' ? 0.75 : 0.5}});
    auto answer = ask(letter, letter == 'P' ? "NOD.MTN" : "", 1);
    EXPECT_EQ('V', request().at(0)) << "so that they hold for the motion";
    EXPECT_EQ(letter, request().at(0));
    EXPECT_EQ("", request());
  }
  commandJoints({{2, 0.5}});
  auto stop = ask('P');
  EXPECT_EQ('P', request().at(0));
  EXPECT_EQ('J', request().at(0)) << "stopping a motion drops nothing";
}

TEST_F(Version2SessionTest, SpeedLimitsGoFirst) {
  commandJoints({{2, 0.5}});
  limitSpeed({{2, 0.75}, {3, 1}});
  EXPECT_EQ("V2", request());
  version2::SpeedLimits limits;
  ASSERT_EQ(nullptr, version2::decode(frame_.payload.data(), frame_.payload.size(), &limits));
  ASSERT_EQ(2, limits.count);
  EXPECT_EQ(750000, limits.joints[0].value);
  EXPECT_EQ("J3", request());
}

TEST_F(Version2SessionTest, ASpeedLimitThatTheRobotHasIsNotSentAgain) {
  limitSpeed({{2, 0.75}, {3, 1}});
  EXPECT_EQ("V2", request());
  limitSpeed({{2, 0.75}, {3, 1}});
  EXPECT_EQ("", request());
  limitSpeed({{2, 0.75}, {3, 2}});
  EXPECT_EQ("V3", request());
  version2::SpeedLimits limits;
  ASSERT_EQ(nullptr, version2::decode(frame_.payload.data(), frame_.payload.size(), &limits));
  ASSERT_EQ(1, limits.count);
  EXPECT_EQ(3, limits.joints[0].id);
}

TEST_F(Version2SessionTest, SpeedLimitsThatTheRobotHasRefusedAreSentAgain) {
  limitSpeed({{2, 0.5}, {99, 0.5}});
  EXPECT_EQ("V2", request());
  limitSpeed({{3, 0.75}});
  EXPECT_EQ("V3", request());
  receive(makeError(2, 1, "there is no joint 99, so nothing of the request was done"));
  limitSpeed({{99, 0.5}, {3, 0.75}, {2, 0.5}});
  EXPECT_EQ("V4", request());
  EXPECT_EQ(Bytes({99, 0, 0, 0, 0, 7, 161, 32, 2, 0, 0, 0, 0, 7, 161, 32}), frame_.payload) << "it has that of joint 3";
}

TEST_F(Version2SessionTest, ACommandWithoutAnAnswerEndsTheConnection) {
  commandJoints({{2, 0.5}});
  EXPECT_EQ("J2", request());
  live(milliseconds(999));
  EXPECT_EQ("robot:54321 did not answer the request 'J' within 1000 ms", whyGivenUp([this] { live(milliseconds(1)); }));
}

TEST_F(Version2SessionTest, OfVelocitiesToWalkWithTheNewestIsSentWhenTheOneBeforeIsAnswered) {
  steer({0.15, -0.06, 1.2});
  EXPECT_EQ("S2", request());
  EXPECT_EQ(Bytes({0, 150, 0xff, 0xc4, 0x04, 0xb0, 0, 0}), frame_.payload);
  for (int i = 0; i < 100; ++i) {
    steer({0.001 * i, 0, 0});
    EXPECT_EQ("", request());
  }
  EXPECT_TRUE(steered_.empty());
  receive(makeFrame('s', 2, {0, 100, 0xff, 0xc4, 0x04, 0xb0, 0, 0}));
  ASSERT_EQ(1u, steered_.size());
  EXPECT_DOUBLE_EQ(0.1, steered_[0].forward) << "as the robot accepted it";
  EXPECT_DOUBLE_EQ(-0.06, steered_[0].left);
  EXPECT_DOUBLE_EQ(1.2, steered_[0].turn);
  EXPECT_THAT(steered_orders_, testing::ElementsAre(kFirstOrder));
  EXPECT_EQ("S3", request());
  EXPECT_EQ(Bytes({0, 99, 0, 0, 0, 0, 0, 0}), frame_.payload);
}

TEST_F(Version2SessionTest, AVelocityThatHadToWaitForLongIsDropped) {
  steer({0.1, 0, 0});
  EXPECT_EQ("S2", request());
  steer({0.05, 0, 0});
  live(milliseconds(500));
  pass(milliseconds(1));
  receive(makeFrame('s', 2, {0, 100, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ("", request());
  EXPECT_EQ(1, logged("A velocity to walk with was dropped: too old: it could not be sent to robot:54321 in time"));
}

TEST_F(Version2SessionTest, AVelocityIsNotHeldUpByJointsButWaitsForTheirSpeedLimits) {
  for (int i = 0; i < 4; ++i) {
    commandJoints({{2, 0.1 * i}});
    request();
  }
  steer({0.1, 0, 0});
  EXPECT_EQ("S6", request());
  receive(makeFrame('s', 6, {0, 100, 0, 0, 0, 0, 0, 0}));
  limitSpeed({{11, 4.8}});
  steer({0.1, 0, 0});
  EXPECT_EQ("", request());
  receive(makeFrame('j', 2, {0, 0, 0, 0}));
  EXPECT_EQ("V7", request());
  EXPECT_EQ("S8", request());
}

TEST_F(Version2SessionTest, WhatStopsTheRobotOrTakesAPostureDropsTheVelocityBeforeIt) {
  for (const char letter : {'I', 'O', 'E'}) {
    steer({0.1, 0, 0});
    auto answer = ask(letter);
    EXPECT_EQ(letter, request().at(0));
    EXPECT_EQ("", request());
  }
  steer({0.1, 0, 0});
  auto answer = ask('O', "", 1);
  EXPECT_EQ('O', request().at(0));
  EXPECT_EQ('S', request().at(0)) << "switching the motors on stops nothing";
}

TEST_F(Version2SessionTest, ARefusalToWalkIsLoggedOnceUntilItWalks) {
  for (int i = 0; i < 3; ++i) {
    steer({0.1, 0, 0});
    request();
    receive(makeError(frame_.header.request_number, 0, "its motors are off"));
  }
  EXPECT_EQ(1, logged("refused to walk: its motors are off"));
  EXPECT_TRUE(steered_.empty());
  steer({0.1, 0, 0});
  request();
  receive(makeFrame('s', frame_.header.request_number, {0, 100, 0, 0, 0, 0, 0, 0}));
  steer({0.1, 0, 0});
  request();
  receive(makeError(frame_.header.request_number, 0, "its motors are off"));
  EXPECT_EQ(2, logged("refused to walk: its motors are off"));
}

TEST_F(Version2SessionTest, ASteeringAnswerOfAnotherLayoutIsAProtocolError) {
  steer({0.1, 0, 0});
  request();
  EXPECT_THAT(faultOf(makeFrame('s', 2, {0, 100, 0, 0, 0, 0})), HasSubstr("bad reply to steering"));
}

TEST_F(Version2SessionTest, APostureIsTakenByItsNumberAndItsAnswerIsNoError) {
  auto posture = askForPosture(2);
  EXPECT_EQ("E2", request());
  EXPECT_EQ(2, frame_.header.id);
  EXPECT_TRUE(frame_.payload.empty());
  receive(makeFrame('e', 2, {}));
  EXPECT_EQ(CallOutcome::kDone, posture.get().outcome);
  auto refused = askForPosture(3);
  EXPECT_EQ("E3", request());
  receive(makeError(3, 0, "it lies on its side"));
  EXPECT_EQ("robot:54321 refused to take the posture rest: it lies on its side.", refused.get().problem);
}

TEST_F(Version2SessionTest, APostureThatHasNotBeenSentIsNotTakenAfterAStop) {
  limitSpeed({{11, 4.8}});
  auto posture = askForPosture(1);
  auto stop_motions = ask('P');
  EXPECT_FALSE(done(posture)) << "that stops motions only";
  auto held = ask('I');
  ASSERT_TRUE(done(posture));
  EXPECT_EQ("robot:54321 was told to hold its joints before it was asked to take the posture stand.",
            posture.get().problem);
}

TEST_F(Version2SessionTest, AReportThatItLiesOnItsSideIsOverWhenItWalksAgain) {
  const auto fallAndMoveAgain = [&](char letter) {
    receive(makeError(0, 0, "the robot lies on its side"));
    EXPECT_THAT(connection_.robot_message, HasSubstr("lies on its side"));
    if (letter == 'S') {
      steer({0.1, 0, 0});
      request();
      receive(makeFrame('s', frame_.header.request_number, {0, 100, 0, 0, 0, 0, 0, 0}));
    } else {
      auto posture = askForPosture(1);
      request();
      receive(makeFrame('e', frame_.header.request_number, {}));
    }
    return connection_.robot_message;
  };
  EXPECT_EQ("", fallAndMoveAgain('S'));
  EXPECT_EQ("", fallAndMoveAgain('E'));
  receive(makeError(0, 3, "head_pan does not follow"));
  EXPECT_THAT(fallAndMoveAgain('S'), HasSubstr("head_pan does not follow")) << "that still holds";
  receive(makeError(0, 3, "mouth does not follow"));
  EXPECT_THAT(fallAndMoveAgain('E'), HasSubstr("mouth does not follow")) << "the newest";
}

TEST_F(Version2SessionTest, OnlyARobotThatWalksIsAskedHowItWalks) {
  pass(milliseconds(250));
  EXPECT_EQ("H2", request());
  receive(makeFrame('h', 2, version2_frames::makeHello("S")));
  EXPECT_DOUBLE_EQ(0.15, connection_.robot.walk_limits.forward);
  EXPECT_DOUBLE_EQ(0.1, connection_.robot.walk_limits.back);
  EXPECT_DOUBLE_EQ(0.06, connection_.robot.walk_limits.left);
  EXPECT_DOUBLE_EQ(1.2, connection_.robot.walk_limits.turn);
  wish_.telemetry_period = 4;
  EXPECT_EQ("T3", request());
  EXPECT_EQ(version2::TELEMETRY_WITH_DUTY | version2::TELEMETRY_WITH_WALK, frame_.header.id);
  receive(makeFrame('t', 3, {0, 4}));
  receive(makeFrame(
      't', 0,
      version2_frames::makeTelemetry(
          99, {{'W', 1, 120000}, {'W', 2, -30000}, {'W', 3, 500000}, {'W', 4, 250000}, {'W', 5, 2}, {'W', 77, 1}})));
  ASSERT_EQ(1u, telemetry_.size());
  ASSERT_TRUE(telemetry_[0].walk);
  EXPECT_DOUBLE_EQ(0.12, telemetry_[0].walk->velocity.forward);
  EXPECT_DOUBLE_EQ(-0.03, telemetry_[0].walk->velocity.left);
  EXPECT_DOUBLE_EQ(0.5, telemetry_[0].walk->velocity.turn);
  EXPECT_DOUBLE_EQ(0.25, telemetry_[0].walk->phase);
  EXPECT_EQ(WalkState::kWalks, telemetry_[0].walk->state);
  receive(makeFrame('t', 0, version2_frames::makeTelemetry(103, {{'W', 5, 9}, {'J', 1, 0}})));
  EXPECT_EQ(WalkState::kUnknown, telemetry_[1].walk->state);
  receive(makeFrame('t', 0, version2_frames::makeTelemetry(107, {{'J', 1, 0}})));
  EXPECT_FALSE(telemetry_[2].walk);
  live(milliseconds(250));  // from now on, it says that it cannot walk
  wish_.telemetry_period = 8;
  EXPECT_EQ('T', request()[0]);
  EXPECT_EQ(version2::TELEMETRY_WITH_DUTY, frame_.header.id);
}

TEST_F(Version2SessionTest, LedsAreReportedAsTheRobotAcceptedThem) {
  commandLeds({{6, 1}, {7, 255, LedMode::kB}});
  EXPECT_EQ("L2", request());
  EXPECT_EQ(Bytes({6, 1, 0, 0, 7, 255, 1, 0}), frame_.payload);
  receive(makeFrame('l', 2, {6, 255, 0, 0, 7, 200, 1, 0}));
  EXPECT_EQ("6=255A 7=200B ", leds_);
  commandLeds({{99, 1}});
  EXPECT_EQ("L3", request());
  receive(makeError(3, 0, "there is no LED 99"));
  EXPECT_EQ("6=255A 7=200B ", leds_) << "what was refused is not reported";
  commandLeds({{7, 1}});
  EXPECT_EQ("L4", request());
  EXPECT_THROW(receive(makeFrame('l', 4, {7, 1, 9, 0})), ProtocolException);
}

TEST_F(Version2SessionTest, LedsAndEarsWaitForTheAnswerBeforeAndThenTheLatestIsNext) {
  commandLeds({{7, 1}});
  EXPECT_EQ("L2", request());
  commandEars(true, false);
  EXPECT_EQ("K3", request());
  EXPECT_EQ(Bytes({1, 0}), frame_.payload);
  for (int i = 0; i < 100; ++i) {
    commandLeds({{7, i}});
    commandEars(false, i % 2 != 0);
    EXPECT_EQ("", request());
  }
  receive(makeFrame('l', 2, {7, 1, 0, 0}));
  EXPECT_EQ("L4", request());
  EXPECT_EQ(Bytes({7, 99, 0, 0}), frame_.payload);
  receive(makeError(3, 0, "the ears are stuck"));
  EXPECT_EQ(1, logged("refused to move the ears: the ears are stuck"));
  EXPECT_EQ("K5", request());
  EXPECT_EQ(Bytes({0, 1}), frame_.payload);
}

TEST_F(Version2SessionTest, ARefusalIsLoggedAgainOnlyAfterSuchACommandWasTaken) {
  for (int i = 0; i < 3; ++i) {
    commandLeds({{99, 1}});
    request();
    receive(makeError(frame_.header.request_number, 0, "there is no LED 99"));
    commandJoints({{1, 0}});
    request();
    receive(makeFrame('j', frame_.header.request_number, {0, 0, 0, 0}));
  }
  EXPECT_EQ(1, logged("refused to set LEDs: there is no LED 99"));
  EXPECT_EQ(3u, counters_.refusals);
  commandLeds({{1, 1}});
  request();
  receive(makeFrame('l', frame_.header.request_number, {1, 1, 0, 0}));
  commandLeds({{99, 1}});
  request();
  receive(makeError(frame_.header.request_number, 0, "there is no LED 99"));
  EXPECT_EQ(2, logged("refused to set LEDs: there is no LED 99"));
}

TEST_F(Version2SessionTest, MotorsAreSwitchedAndTheirStateReported) {
  auto answer = ask('O', "", 1);
  EXPECT_EQ("O2", request());
  EXPECT_EQ(Bytes({1}), frame_.payload);
  receive(makeFrame('o', 2, {1}));
  EXPECT_TRUE(answer.get().motors_on);
  auto refused = ask('O', "", 1);
  EXPECT_EQ("O3", request());
  receive(makeError(3, 0, "the battery is low"));
  EXPECT_EQ("robot:54321 refused to switch the motors on: the battery is low.", refused.get().problem);
}

TEST_F(Version2SessionTest, MotionsAreUploadedPlayedStoppedListedAndDeleted) {
  auto upload = ask('U', "NOD.MTN", 0, {1, 2, 3});
  EXPECT_EQ("U2", request());
  EXPECT_EQ(Bytes({7, 'N', 'O', 'D', '.', 'M', 'T', 'N', 1, 2, 3}), frame_.payload);
  receive(makeFrame('u', 2, {}));
  EXPECT_EQ(CallOutcome::kDone, upload.get().outcome);
  auto play = ask('P', "NOD.MTN", 258);
  EXPECT_EQ("P3", request());
  EXPECT_EQ(Bytes({1, 2, 'N', 'O', 'D', '.', 'M', 'T', 'N'}), frame_.payload);
  auto stop = ask('P');
  EXPECT_EQ("P4", request());
  EXPECT_EQ(Bytes({0, 0}), frame_.payload);
  receive(makeFrame('p', 4, {}));
  EXPECT_EQ(CallOutcome::kDone, stop.get().outcome);
  EXPECT_FALSE(done(play));
  receive(makeFrame('p', 3, {}));
  EXPECT_EQ(CallOutcome::kDone, play.get().outcome);
  auto list = ask('N');
  EXPECT_EQ("N5", request());
  receive(makeFrame('n', 5, {'A', '.', 'M', 'T', 'N', '\n', 'B', '.', 'M', 'T', 'N'}));
  EXPECT_THAT(list.get().names, testing::ElementsAre("A.MTN", "B.MTN"));
  auto deletion = ask('D', "NOD.MTN");
  EXPECT_EQ("D6", request());
  EXPECT_EQ(Bytes({'N', 'O', 'D', '.', 'M', 'T', 'N'}), frame_.payload);
  receive(makeError(6, 1, "there is no motion NOD.MTN"));
  EXPECT_EQ("robot:54321 refused to delete the motion NOD.MTN: there is no motion NOD.MTN.", deletion.get().problem);
}

TEST_F(Version2SessionTest, ACallMayTakeItsTimeAndALateAnswerIsIgnored) {
  auto answer = ask('U', "NOD.MTN", 0, {1, 2, 3}, milliseconds(4000));
  EXPECT_EQ("U2", request());
  live(milliseconds(3999));
  EXPECT_FALSE(done(answer));
  live(milliseconds(1));
  const Answer nothing = answer.get();
  EXPECT_EQ("no answer within 4000 ms. The robot may or may not store the motion NOD.MTN.", nothing.problem);
  EXPECT_TRUE(nothing.was_sent);
  receive(makeFrame('u', 2, {}));
  live(milliseconds(1000));
  EXPECT_TRUE(late_answers_.empty()) << "it has no number";
}

TEST_F(Version2SessionTest, ALateAnswerToANumberedCallIsTold) {
  const auto play = [this](std::uint64_t number) {
    Call call = callToPlay("NOD.MTN", 1, 0);
    call.order = number;
    auto answer = add(std::move(call), milliseconds(1000));
    EXPECT_EQ('P', request().at(0));
    const int request_number = frame_.header.request_number;
    live(milliseconds(1000));
    EXPECT_EQ("no answer within 1000 ms. The robot may or may not play the motion NOD.MTN.", answer.get().problem);
    return request_number;
  };
  const int first = play(7);
  const int second = play(8);
  receive(makeError(second, 1, "there is no NOD.MTN"));
  receive(makeFrame('p', first, {'c', 'l', 'i', 'p'}));
  receive(makeFrame('p', first, {}));
  ASSERT_EQ(2u, late_answers_.size());
  EXPECT_EQ(8u, late_answers_[0].order);
  EXPECT_FALSE(late_answers_[0].accepted);
  EXPECT_THAT(late_answers_[0].reason, HasSubstr("there is no NOD.MTN"));
  EXPECT_EQ(7u, late_answers_[1].order);
  EXPECT_TRUE(late_answers_[1].accepted);
  EXPECT_EQ("clip", late_answers_[1].changes);
  std::vector<int> numbers;
  for (std::uint64_t order = 100; order <= 164; ++order) {
    numbers.push_back(play(order));
  }
  for (const int number : numbers) {
    receive(makeFrame('p', number, {}));
  }
  ASSERT_EQ(2u + 64u, late_answers_.size()) << "the oldest of 65 is forgotten";
  EXPECT_EQ(101u, late_answers_[2].order);
}

TEST_F(Version2SessionTest, AnOrderThatTimesOutBeforeItIsSentIsNotSentLater) {
  auto upload = ask('U', "NOD.MTN", 0, {1, 2, 3}, milliseconds(10000));
  EXPECT_EQ("U2", request());
  Call call = callToPlay("SIT.MTN", 1, 0);
  call.order = 7;
  auto play = add(std::move(call), milliseconds(100));
  EXPECT_EQ("", request());
  pass(milliseconds(100));
  ASSERT_TRUE(done(play));
  const Answer answer = play.get();
  EXPECT_EQ(CallOutcome::kTimeout, answer.outcome);
  EXPECT_EQ("the request could not be sent within 100 ms.", answer.problem);
  EXPECT_FALSE(answer.was_sent);
  receive(makeFrame('u', 2, {}));
  EXPECT_EQ("", request());
}

TEST_F(Version2SessionTest, AnOrderThatCouldNotBeSentInTimeIsTooOld) {
  auto upload = ask('U', "NOD.MTN", 0, {1, 2, 3}, milliseconds(10000));
  EXPECT_EQ("U2", request());
  const auto order = [this](int time) {
    Call call = callToPlay("SIT.MTN", 1, 0);
    call.not_after = now_ + milliseconds(time);
    return add(std::move(call), milliseconds(5000));
  };
  auto later = order(150);
  auto play = order(100);
  auto last = order(200);
  EXPECT_EQ("", request());
  pass(milliseconds(99));
  EXPECT_FALSE(done(play));
  pass(milliseconds(1));
  ASSERT_TRUE(done(play));
  EXPECT_FALSE(done(later));
  pass(milliseconds(50));
  EXPECT_TRUE(done(later) && !done(last));
  pass(milliseconds(50));
  EXPECT_TRUE(done(last));
  const Answer answer = play.get();
  EXPECT_EQ(CallOutcome::kRefused, answer.outcome);
  EXPECT_EQ("The order to play the motion SIT.MTN is too old: it could not be sent to robot:54321 in time.",
            answer.problem);
  receive(makeFrame('u', 2, {}));
  EXPECT_EQ("", request());
}

TEST_F(Version2SessionTest, TheRobotIsAskedForItsMotorsAndTellsOfThemFromThenOn) {
  pass(session_.nextDeadline() - now_);
  EXPECT_EQ("H2", request());
  receive(makeFrame('h', 2, version2_frames::makeHello("O")));
  EXPECT_EQ("O3", request());
  EXPECT_TRUE(frame_.payload.empty());
  receive(makeFrame('o', 3, {1}));
  EXPECT_EQ("", request());
  EXPECT_EQ(MotorState::kUnknown, connection_.motors_and_posture.motors) << "an older server does not tell of changes";
  receive(makeFrame('o', 0, {1, version2::POSTURE_SIT, 0, 0}));
  EXPECT_EQ(MotorState::kOn, connection_.motors_and_posture.motors);
  EXPECT_EQ(PostureNow::kSitting, connection_.motors_and_posture.posture);
  receive(makeFrame('o', 0, {0, 77, 0, 0}));
  EXPECT_EQ(MotorState::kOff, connection_.motors_and_posture.motors);
  EXPECT_EQ(PostureNow::kUnknown, connection_.motors_and_posture.posture) << "of a newer server";
  EXPECT_THAT(faultOf(makeFrame('o', 0, {1})), HasSubstr("bad state of motors and posture"));
}

/// The user is told of refusals.
class Version2RefusalsTest : public SessionFixture {
 protected:
  Version2RefusalsTest() : SessionFixture(true) {}
  Session& session() override { return session_; }

  void SetUp() override {
    EXPECT_EQ('H', request());
    receive(makeFrame('h', number_, version2_frames::makeHello()));
  }

  char request() {
    const Bytes bytes = session_.nextRequest(wish_, now_);
    if (bytes.empty()) {
      return ' ';
    }
    number_ = version2_frames::split(bytes).header.request_number;
    return static_cast<char>(bytes[0]);
  }

  int number_ = 0;  // of the last request
  Version2Session session_{connection_, now_};
};

TEST_F(Version2RefusalsTest, WhatTheRobotRefusesIsToldWithItsOrderAndItsParts) {
  commandJoints({{2, 0.5}, {1, -0.1}});
  steer({0.1, 0, 0});
  limitSpeed({{3, 1}, {2, 5}});
  commandLeds({{7, 255}, {3, 1}});
  commandEars(true, false);
  for (const char letter : {'V', 'S', 'J', 'L', 'K'}) {
    EXPECT_EQ(letter, request());
    receive(makeError(number_, 0, std::string("no ") + letter));
  }
  expectRefusals({{RefusedRequest::kSpeedLimits, RefusalCause::kRobot, {3, 2}, "no V", 0},
                  {RefusedRequest::kWalk, RefusalCause::kRobot, {}, "no S", kFirstOrder + 1},
                  {RefusedRequest::kJoints, RefusalCause::kRobot, {2, 1}, "no J", kFirstOrder},
                  {RefusedRequest::kLeds, RefusalCause::kRobot, {7, 3}, "no L", 0},
                  {RefusedRequest::kEars, RefusalCause::kRobot, {1, 2}, "no K", 0}});
  EXPECT_EQ(5u, counters_.refusals);
  EXPECT_TRUE(log_.empty());
}

TEST_F(Version2RefusalsTest, WhatAStopComesBeforeIsTold) {
  commandJoints({{2, 0.5}});
  steer({0.1, 0, 0});
  auto held = askToHold({2});  // the legs are not held
  const std::string hold = "the robot was told to hold its joints before it was sent";
  expectRefusals({{RefusedRequest::kJoints, RefusalCause::kStopped, {2}, hold, kFirstOrder}});
  commandJoints({{1, 0.5}});
  commandJoints({{3, 0.5}});
  auto posture = askForPosture(2);
  const std::string sit = "the robot was told to take the posture sit before it was sent";
  expectRefusals({{RefusedRequest::kJoints, RefusalCause::kStopped, {1}, sit, kFirstOrder + 2},
                  {RefusedRequest::kJoints, RefusalCause::kStopped, {3}, sit, kFirstOrder + 3},
                  {RefusedRequest::kWalk, RefusalCause::kStopped, {}, sit, kFirstOrder + 1}});
  commandJoints({{1, 0.5}});
  EXPECT_EQ('I', request());
  EXPECT_EQ('E', request());
  EXPECT_EQ('J', request()) << "it came after them";
  steer({0.1, 0, 0});
  auto leg_held = askToHold({2, 11, 3});
  expectRefusals({{RefusedRequest::kWalk, RefusalCause::kStopped, {}, hold, kFirstOrder + 5}});
}

TEST_F(Version2RefusalsTest, AJointThatDoesNotFollowIsNamed) {
  receive(makeError(0, 3, "left_front_knee is jammed: its motor pushes and it does not move"));
  receive(makeError(0, 3, "NOD.MTN is stopped: tail_pan and head_pan do not follow"));
  expectRefusals({{RefusedRequest::kJoints,
                   RefusalCause::kJointFault,
                   {13},
                   "left_front_knee is jammed: its motor pushes and it does not move",
                   0},
                  {RefusedRequest::kJoints,
                   RefusalCause::kJointFault,
                   {2, 51},
                   "NOD.MTN is stopped: tail_pan and head_pan do not follow",
                   0}});
}

TEST_F(Version2SessionTest, BehindALargeUploadAnswersAndPicturesMayBeLate) {
  wish_.streaming = true;
  EXPECT_EQ("W2", request());
  receive(makeFrame('w', 2, {1, 0, 0, 1}));
  auto answer = ask('U', "NOD.MTN", 0, Bytes(65523), milliseconds(20000));
  EXPECT_EQ("U3", request());
  for (int number = 4; number <= 10; ++number) {
    pass(milliseconds(250));
    EXPECT_EQ("H" + std::to_string(number), request());
  }
  pass(milliseconds(150));
  receive(makeFrame('u', 3, {}));
  for (int number = 4; number <= 10; ++number) {
    receive(makeFrame('h', number, version2_frames::makeHello()));
  }
  live(milliseconds(499));
  EXPECT_EQ(kSilentStream, whyGivenUp([this] { live(milliseconds(1)); }))
      << "it has been answered, so pictures are due again";
}

TEST_F(Version2SessionTest, AnAnswerToAnotherCallDoesNotMeanThatALargeFileHasCome) {
  auto fetch = add(callToFetchPicture("AIBO0001.JPG"), milliseconds(20000));
  EXPECT_EQ("Y2", request());
  auto motors = ask('O', "", 1);
  auto other = ask('O', "", 1);
  EXPECT_EQ("O3", request());
  EXPECT_EQ("O4", request());
  receive(makeFrame('o', 3, {1}));
  receive(makeError(4, 0, "the battery is low"));
  for (int i = 0; i < 19; ++i) {  // what is sent now is answered behind the file, which may take 4 s
    request();
    pass(milliseconds(250));
  }
  request();
  pass(milliseconds(249));
  EXPECT_EQ("robot:54321 did not answer the request 'H' within 4750 ms", whyGivenUpWithin(milliseconds(1)))
      << "the file has come, or never will";
}

TEST_F(Version2SessionTest, AfterALargeUploadThatWasRefusedPicturesAreDueAsEver) {
  wish_.streaming = true;
  request();
  receive(makeFrame('w', 2, {1, 0, 0, 1}));
  auto answer = ask('U', "NOD.MTN", 0, Bytes(65523), milliseconds(20000));
  EXPECT_EQ("U3", request());
  receive(makeError(3, 0, "the memory stick is full"));
  live(milliseconds(499));
  EXPECT_EQ(kSilentStream, whyGivenUp([this] { live(milliseconds(1)); }));
}

TEST_F(Version2SessionTest, AMalformedListIsAProtocolError) {
  auto answer = ask('N');
  request();
  EXPECT_THAT(faultOf(makeFrame('n', 2, {'A', '/', '.', '.'})),
              HasSubstr("bad answer to the request to list its motions: "));
}

TEST_F(Version2SessionTest, TextsAreCutAt512BytesBetweenCharacters) {
  const auto report = [this](const std::string& text) {
    Bytes payload = {0, 3};
    payload.insert(payload.end(), text.begin(), text.end());
    receive(makeFrame('e', 0, payload));
  };
  const std::string most(511, 'x');
  report(most + "\xc3\xa9" + std::string(60000, 'y'));
  EXPECT_EQ(most + "...", connection_.robot_message);
  report(most + "x");
  EXPECT_EQ(most + "x", connection_.robot_message);
}

TEST_F(Version2SessionTest, NamesAndReasonsOfEndsAreCutAt512Bytes) {
  const std::string text(60000, 'x');
  const std::string both = text + "\n" + std::string(60000, 'y');
  for (const std::uint8_t what : {version2::ENDED_MOTION, version2::ENDED_JAM}) {
    Bytes payload = {what, version2::END_REFUSED, 0, 0};
    payload.insert(payload.end(), both.begin(), both.end());
    receive(makeFrame('i', 0, payload));
  }
  ASSERT_EQ(2u, ended_.size());
  EXPECT_EQ(std::string(512, 'x') + "...", ended_[0].name);
  EXPECT_EQ(std::string(512, 'y') + "...", ended_[0].reason);
  ASSERT_EQ(1u, log_.size());
  EXPECT_LT(log_[0].size(), 600u);
}

TEST_F(Version2SessionTest, ReportsOfAJointAreOverWhenItFollowsAgain) {
  const auto follows = [this](const std::string& joint) {
    receive(makeFrame('i', 0, version2_frames::makeEnd(version2::ENDED_JAM, version2::END_DONE, joint, "")));
    return connection_.robot_message;
  };
  for (const char* const joint : {"mouth", "tail_tilt", "mouth", "head_pan"}) {
    receive(makeError(0, 3, joint + std::string(" is jammed")));
  }
  receive(makeError(0, 3, "NOD.MTN is stopped: head_pan does not follow."));
  EXPECT_EQ("NOD.MTN is stopped: head_pan does not follow.", connection_.robot_message);
  EXPECT_EQ("NOD.MTN is stopped: head_pan does not follow.", follows("head"));
  EXPECT_EQ("mouth is jammed", follows("head_pan"));
  EXPECT_EQ("tail_tilt is jammed", follows("mouth"));
  EXPECT_EQ("", follows("tail_tilt"));
  receive(makeError(0, 4, "the battery below the mouth is low"));
  EXPECT_EQ("the battery below the mouth is low", follows("mouth")) << "no joint's fault";
  EXPECT_EQ(2, logged("The joint mouth follows its commands again."));
  EXPECT_EQ(2, logged("robot:54321 reports: mouth is jammed."));
}

TEST_F(Version2SessionTest, ReportsAreForgottenOnlyOneByOneHoweverManyThereAre) {
  for (int i = 0; i < 100; ++i) {
    receive(makeError(0, 3, "joint" + std::to_string(i) + " is jammed"));
    receive(makeError(0, 3, "joint" + std::to_string(i) + " is jammed"));
  }
  for (int i = 99; i > 99 - 32; --i) {
    EXPECT_EQ("joint" + std::to_string(i) + " is jammed", connection_.robot_message);
    receive(makeFrame(
        'i', 0, version2_frames::makeEnd(version2::ENDED_JAM, version2::END_DONE, "joint" + std::to_string(i), "")));
  }
  EXPECT_EQ("", connection_.robot_message);
}

TEST_F(Version2SessionTest, PushesOfUnknownKindsAndRepliesToUnknownNumbersAreIgnored) {
  receive(makeFrame('x', 0, {1, 2, 3}));
  receive(makeFrame('j', 4711, {1, 2, 3}));
  receive(makeError(4711, 0, "too late"));
  EXPECT_TRUE(log_.empty());
}

TEST_F(Version2SessionTest, GarbageIsAProtocolError) {
  EXPECT_THAT(faultOf(Bytes(8, 0)), HasSubstr("a frame that begins with byte 0"));
  EXPECT_THAT(faultOf({'z' + 1, 0, 0, 0, 0, 0, 0, 0}), HasSubstr("a frame that begins with byte 123"));
}

TEST_F(Version2SessionTest, AFrameThatIsTooLargeIsAProtocolErrorAsSoonAsItIsAnnounced) {
  EXPECT_THAT(faultOf({'f', 0, 0, 0, 0, 4, 0, 1}), HasSubstr("a frame of 262145 bytes; at most 262144 are possible"));
}

TEST_F(Version2SessionTest, AReplyOfAnotherKindThanTheRequestIsAProtocolError) {
  commandJoints({{2, 0.5}});
  EXPECT_EQ("J2", request());
  EXPECT_THAT(faultOf(makeFrame('v', 2, {})), HasSubstr("a reply 'v' to the request 'J'"));
}

TEST_F(Version2SessionTest, APayloadThatDoesNotFitItsKindIsAProtocolError) {
  EXPECT_THAT(faultOf(makeFrame('t', 0, {1, 2, 3})), HasSubstr("bad telemetry: "));
  EXPECT_THAT(faultOf(makeFrame('f', 0, {1, 2, 3})), HasSubstr("bad picture: "));
  EXPECT_THAT(faultOf(makeFrame('e', 0, {1})), HasSubstr("bad error message: "));
}

TEST_F(Version2SessionTest, RequestNumbersBeginAgainAndSkipThoseStillAwaited) {
  auto answer = takePicture(10, std::chrono::hours(1));
  EXPECT_EQ("F2", request());
  for (int i = 0; i < 65532; ++i) {
    commandJoints({{2, 0}});
    request();
    receive(makeFrame('j', frame_.header.request_number, {0, 0, 0, 0}));
  }
  EXPECT_EQ(65534, frame_.header.request_number);
  std::string numbers;
  for (int i = 0; i < 3; ++i) {
    commandJoints({{2, 0}});
    numbers += request() + " ";
  }
  EXPECT_EQ("J65535 J1 J3 ", numbers);
}

TEST_F(Version2SessionTest, HoldIsForEverythingOrForTheJointsNamed) {
  auto everything = ask('I');
  EXPECT_EQ("I2", request());
  EXPECT_EQ(version2::HOLD_EVERYTHING, frame_.header.id);
  EXPECT_EQ(Bytes(), frame_.payload);
  auto two = askToHold({2, 52});
  EXPECT_EQ("I3", request());
  EXPECT_EQ(version2::HOLD_JOINTS, frame_.header.id);
  EXPECT_EQ(Bytes({2, 52}), frame_.payload);
  receive(makeFrame('i', 2, {}));
  EXPECT_EQ(CallOutcome::kDone, everything.get().outcome);
  EXPECT_FALSE(done(two));
  receive(makeError(3, 0, "there is no joint 52"));
  EXPECT_EQ("robot:54321 refused to hold its joints: there is no joint 52.", two.get().problem);
}

TEST_F(Version2SessionTest, EveryKindAndWayOfEndIsToldAndThoseOfANewerServerAreUnknown) {
  int how = 255;
  for (const int kind : {0, 1, 2, 3, 4, 5, 255}) {
    receive(makeFrame('i', 0, version2_frames::makeEnd(kind, how, "NOD.MTN", "told to")));
    EXPECT_EQ("NOD.MTN: told to", ended_.back().name + ": " + ended_.back().reason);
    how = how == 255 ? 5 : how - 1;
  }
  std::vector<EndedKind> kinds;
  std::vector<EndedHow> hows;
  for (const MotionEnd& end : ended_) {
    kinds.push_back(end.kind);
    hows.push_back(end.how);
  }
  EXPECT_THAT(kinds,
              testing::ElementsAre(EndedKind::kUnknown, EndedKind::kMotion, EndedKind::kWalk, EndedKind::kPosture,
                                   EndedKind::kJam, EndedKind::kUnknown, EndedKind::kUnknown));
  EXPECT_THAT(hows, testing::ElementsAre(EndedHow::kUnknown, EndedHow::kUnknown, EndedHow::kFell, EndedHow::kRefused,
                                         EndedHow::kStopped, EndedHow::kReplaced, EndedHow::kDone));
}

TEST_F(Version2SessionTest, ADamagedReportOfAnEndIsAFault) {
  EXPECT_THAT(faultOf(makeFrame('i', 0, {1, 0, 0, 0})), HasSubstr("bad report of an end: there is no newline"));
}

class StopFirstTest : public Version2SessionTest, public testing::WithParamInterface<char> {};

TEST_P(StopFirstTest, AnOrderToStopGoesBeforeEverythingElse) {
  pass(milliseconds(250));  // a heartbeat would be due
  wish_ = {true, 73, 4};
  commandJoints({{2, 0.1}});
  limitSpeed({{2, 1.0}});
  commandLeds({{1, 255}});
  auto picture = takePicture(10);
  auto motors = ask('O', "", 1);
  auto upload = ask('U', "NOD.MTN", 0, {1, 2, 3});
  auto stop = ask(GetParam());
  const Bytes payload = GetParam() == 'O' ? Bytes{0} : Bytes();
  EXPECT_EQ(GetParam(), request()[0]);
  EXPECT_EQ(payload, frame_.payload);
  receive(makeFrame(version2::replyKind(GetParam()), 2, payload));
  ASSERT_TRUE(done(stop));
  EXPECT_EQ(CallOutcome::kDone, stop.get().outcome);
  std::string others;
  for (std::string each = request(); !each.empty(); each = request()) {
    others += each[0];
  }
  EXPECT_EQ("WFVOUTL", others) << "without J, which came before";
}

INSTANTIATE_TEST_SUITE_P(Stops, StopFirstTest, testing::Values('I', 'O'),
                         [](const auto& letter) { return std::string(1, letter.param); });

TEST_F(Version2SessionTest, OnlyTheJointsThatAreHeldForgetTheirCommands) {
  commandJoints({{2, 0.1}, {3, 0.2}});
  commandJoints({{4, 0.3}});
  auto held = askToHold({2, 4});
  commandJoints({{4, 0.4}});
  EXPECT_EQ("I2", request());
  EXPECT_EQ("J3", request());
  EXPECT_EQ(3, frame_.payload.at(4)) << "without joint 2";
  EXPECT_EQ("J4", request());
  EXPECT_EQ(4, frame_.payload.at(4)) << "commanded later";
  EXPECT_EQ("", request());
}

TEST_F(Version2SessionTest, AMotionThatHasNotBeenSentIsNotPlayedAfterAnOrderToStop) {
  auto upload = ask('U', "NOD.MTN", 0, {1, 2, 3});
  EXPECT_EQ("U2", request());
  auto earlier = ask('P', "NOD.MTN", 1);
  auto second = ask('P', "SIT.MTN", 1);
  auto held = ask('I');
  auto later = ask('P', "SIT.MTN", 1);
  ASSERT_TRUE(done(earlier));
  EXPECT_TRUE(done(second));
  const Answer refusal = earlier.get();
  EXPECT_EQ(CallOutcome::kRefused, refusal.outcome);
  EXPECT_EQ("robot:54321 was told to hold its joints before it was asked to play the motion NOD.MTN.", refusal.problem);
  EXPECT_EQ("I3", request());
  EXPECT_EQ("", request());
  receive(makeFrame('u', 2, {}));
  EXPECT_EQ("P4", request());
  EXPECT_FALSE(done(later));
}

TEST_F(Version2SessionTest, AMotionThatHasNotBeenSentIsStoppedByItsName) {
  auto upload = ask('U', "NOD.MTN", 0, {1, 2, 3});
  EXPECT_EQ("U2", request());
  commandJoints({{2, 0.1}});
  auto nod = ask('P', "NOD.MTN", 1);
  auto sit = ask('P', "SIT.MTN", 1);
  auto stop = ask('P', "NOD.MTN", 0);
  ASSERT_TRUE(done(nod));
  EXPECT_EQ("robot:54321 was told to stop the motion NOD.MTN before it was asked to play the motion NOD.MTN.",
            nod.get().problem);
  EXPECT_FALSE(done(sit));
  EXPECT_EQ("P3", request()) << "stopping a motion needs no memory stick";
  EXPECT_EQ("J4", request()) << "it stops no joint";
  auto stop_all = ask('P');
  ASSERT_TRUE(done(sit));
  EXPECT_EQ("robot:54321 was told to stop all motions before it was asked to play the motion SIT.MTN.",
            sit.get().problem);
}

TEST_F(Version2SessionTest, OneRequestForTheMemoryStickIsSentAtATimeAndTheOthersGoOn) {
  auto play = ask('P', "NOD.MTN", 1);
  auto list = ask('N');
  auto erase = ask('D', "NOD.MTN");
  auto motors = ask('O', "", 1);
  EXPECT_EQ("P2", request());
  EXPECT_EQ("O3", request());
  EXPECT_EQ("", request());
  receive(makeFrame('p', 2, {}));
  EXPECT_EQ("N4", request());
  EXPECT_EQ("", request());
  receive(makeError(4, 0, "busy"));
  EXPECT_EQ("D5", request());
}

TEST_F(Version2SessionTest, ARequestForTheMemoryStickIsSentAfterOneThatWasNotAnsweredInTime) {
  auto play = ask('P', "NOD.MTN", 1, {}, milliseconds(300));
  auto list = ask('N');
  EXPECT_EQ("P2", request());
  EXPECT_EQ("", request());
  live(milliseconds(250));
  pass(milliseconds(50));
  EXPECT_EQ("N4", request());
}

}  // namespace
