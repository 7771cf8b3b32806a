// A session of version 2: docs/protocol.md, "Version 2", and rcserver_client.h.
#include "client/version2_session.h"

#include <gmock/gmock.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "client/fault.h"
#include "version2_fixture.h"

using namespace aibo_client;
using std::chrono::milliseconds;
using test_pictures::Bytes;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using version2_frames::makeFrame;

namespace version2 = protocol::version2;

namespace {

class Version2SessionTest : public Version2SessionFixture {
 public:
  explicit Version2SessionTest(bool is_told_of_refusals = false) : Version2SessionFixture(is_told_of_refusals) {
    begin("F W J V T");
  }
};

/// The user is told of refusals; else they are logged.
class Version2RefusalsTest : public Version2SessionTest {
 public:
  Version2RefusalsTest() : Version2SessionTest(true) {}
};

/// For the rows of tables.
struct NewSession : public Version2RefusalsTest {
  void TestBody() override {}
};

// ---- Hello and heartbeat

TEST_F(Version2SessionTest, TheHelloIntroducesTheRobot) {
  const RobotInfo& robot = connection_.robot;
  EXPECT_EQ("ERS-7", robot.design);
  EXPECT_EQ("a test 1.0", robot.server);
  EXPECT_TRUE(robot.hasCapability("J"));
  EXPECT_FALSE(robot.hasCapability("Z"));
  ASSERT_THAT(robot.joint_limits, SizeIs(2));
  EXPECT_EQ(2, robot.joint_limits[1].id);
  EXPECT_DOUBLE_EQ(-1.5, robot.joint_limits[1].lower);
  EXPECT_DOUBLE_EQ(1.6, robot.joint_limits[1].upper);
  EXPECT_DOUBLE_EQ(10, robot.joint_limits[1].speed);
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

TEST_F(Version2SessionTest, AHeartbeatIsSentFourTimesASecondWhileNothingElseIs) {
  int heartbeats = 0;
  for (const TimePoint end = now_ + std::chrono::seconds(10); now_ < end; pass(session_.nextDeadline() - now_)) {
    if (request() == "H 0") {
      ++heartbeats;
      answer(version2_frames::makeHello());
    }
  }
  EXPECT_NEAR(40, heartbeats, 1);
}

TEST_F(Version2SessionTest, AServerThatDoesNotAnswerTheHeartbeatIsGivenUpAlsoWhileNothingIsWanted) {
  for (int i = 0; i < 4; ++i) {
    pass(milliseconds(250));
    EXPECT_EQ("H 0", request());
  }
  pass(milliseconds(249));
  EXPECT_EQ("robot:54321 did not answer the request 'H' within 1000 ms", whyGivenUpWithin(milliseconds(1)));
}

// ---- What ends the connection

TEST(Version2Session, EndsIfTheServerSendsWhatNoneSends) {
  const std::pair<Bytes, std::string> pushes[] = {
      {Bytes(8, 0), "a frame that begins with byte 0"},
      {{'z' + 1, 0, 0, 0, 0, 0, 0, 0}, "a frame that begins with byte 123"},
      {{'f', 0, 0, 0, 0, 4, 0, 1}, "a frame of 262145 bytes; at most 262144 are possible"},
      {makeFrame('t', 0, {1, 2, 3}), "bad telemetry: "},
      {makeFrame('f', 0, {1, 2, 3}), "bad picture: "},
      {makeFrame('e', 0, {1}), "bad error message: "},
      {makeFrame('o', 0, {1}), "bad state of motors and posture"},
      {makeFrame('i', 0, {1, 0, 0, 0}), "bad report of an end: there is no newline"},
  };
  for (const auto& [bytes, problem] : pushes) {
    NewSession session;
    EXPECT_THAT(SessionFixture::whyGivenUp([&, bytes = bytes] { session.receive(bytes); }), HasSubstr(problem));
  }
  const struct {
    std::function<void(NewSession&)> ask;
    Bytes payload;
    std::string problem;
  } replies[] = {
      {[](NewSession& session) { session.add(callForMotions()); },
       {'A', '/', '.', '.'},
       "bad answer to the request to list its mo"},
      {[](NewSession& session) { session.add(callToPlay("NOD.MTN", 1, 0)); },
       {0x1b, '[', 'J'},
       "bad answer to the request to p"},
      {[](NewSession& session) {
         session.steer({0.1, 0, 0});
       },
       {0, 100, 0, 0, 0, 0},
       "bad reply to steering"},
      {[](NewSession& session) {
         session.commandLeds({{7, 1}});
       },
       {7, 1, 9, 0},
       "bad "},
  };
  for (const auto& row : replies) {
    NewSession session;
    row.ask(session);
    session.request();
    EXPECT_THAT(SessionFixture::whyGivenUp([&] { session.answer(row.payload); }), HasSubstr(row.problem));
  }
  NewSession session;
  session.commandJoints({{2, 0.5}});
  session.request();
  session.frame_.header.kind = 'V';
  EXPECT_THAT(SessionFixture::whyGivenUp([&] { session.answer({}); }), HasSubstr("a reply 'v' to the request 'J'"));
}

TEST_F(Version2SessionTest, PushesOfUnknownKindsAndRepliesToUnknownNumbersAreIgnored) {
  receive(makeFrame('x', 0, {1, 2, 3}));
  receive(makeFrame('j', 4711, {1, 2, 3}));
  receive(makeFrame('e', 4711, version2_frames::makeError(0, "too late")));
  EXPECT_THAT(log_, IsEmpty());
}

// ---- Pictures

TEST_F(Version2SessionTest, APictureOfTheStreamHasItsNumbers) {
  stream();
  pushPicture(1, 4711);
  ASSERT_THAT(pictures_, SizeIs(1));
  EXPECT_EQ(test_pictures::makeNumbered(1), pictures_[0]->jpeg);
  EXPECT_EQ(4711u, pictures_[0]->frame_number);
  EXPECT_EQ(version2_frames::kImageCount, pictures_[0]->image_count);
  EXPECT_EQ(208, pictures_[0]->width);
}

TEST_F(Version2SessionTest, AStreamThatIsSilentIsGivenUpThoughTheHeartbeatIsAnswered) {
  live(milliseconds(600));  // a stream that begins late has as much time
  stream();
  live(milliseconds(499));
  pushPicture(1);
  live(milliseconds(499));
  EXPECT_EQ(kSilentStream, whyGivenUp([this] { live(milliseconds(1)); }));
}

TEST_F(Version2SessionTest, APictureMayComeSlowly) {
  stream();
  const Bytes picture = makeFrame('f', 0, version2_frames::makePicture(test_pictures::makeNumbered(1), 0));
  const auto part = static_cast<std::ptrdiff_t>(picture.size() / 4);
  for (std::ptrdiff_t begin = 0; begin < 4 * part; begin += part) {
    now_ += milliseconds(400);
    receive(Bytes(picture.begin() + begin, begin == 3 * part ? picture.end() : picture.begin() + begin + part));
  }
  EXPECT_EQ(1u, counters_.pictures + counters_.stale_pictures);
}

TEST_F(Version2SessionTest, PicturesThatArrivedTogetherAre1NsApart) {
  stream();
  const Bytes picture = makeFrame('f', 0, version2_frames::makePicture(test_pictures::makeNumbered(1), 1));
  Bytes both = picture;
  both.insert(both.end(), picture.begin(), picture.end());
  receive(both);
  ASSERT_THAT(pictures_, SizeIs(2));
  EXPECT_EQ(now_, pictures_[0]->first_byte_time);
  EXPECT_EQ(now_ + std::chrono::nanoseconds(1), pictures_[1]->first_byte_time);
}

TEST_F(Version2SessionTest, PicturesOfAStoppedStreamAreDroppedAndAFaultIfTheyDoNotEnd) {
  stream();
  wish_.streaming = false;
  request();
  answer(frame_.payload);
  pushPicture(1);
  EXPECT_EQ(1u, counters_.unexpected_pictures);
  EXPECT_THAT(pictures_, IsEmpty());
  live(milliseconds(1100));
  EXPECT_THAT(whyGivenUp([this] { pushPicture(2); }), HasSubstr("it goes on sending pictures"));
}

TEST_F(Version2SessionTest, DuringTheStreamEachCallerGetsItsOwnPictureAtItsOwnQualityInAnyOrder) {
  stream();
  auto first = takePicture(10);
  auto second = takePicture(0);
  EXPECT_EQ("F 10 0", request());
  const Frame first_request = frame_;
  EXPECT_EQ("F 73 0", request()) << "0 is the stream's quality";
  EXPECT_EQ("", request());
  pushPicture(1);
  EXPECT_FALSE(done(first)) << "this was the stream's";
  answer(version2_frames::makePicture(test_pictures::makeNumbered(2), 0));
  answer(first_request, version2_frames::makePicture(test_pictures::makeNumbered(3), 0));
  EXPECT_EQ(test_pictures::makeNumbered(2), second.get().picture->jpeg);
  const Answer got = first.get();
  EXPECT_EQ(test_pictures::makeNumbered(3), got.picture->jpeg);
  EXPECT_EQ(0, got.stream_quality);
  EXPECT_THAT(pictures_, SizeIs(3));
}

TEST_F(Version2SessionTest, ACallThatTimesOutLeavesTheConnectionAloneAndItsLatePictureIsDropped) {
  auto taken = takePicture(10, milliseconds(300));
  EXPECT_EQ("F 10 0", request());
  const Frame order = frame_;
  live(milliseconds(300));
  EXPECT_EQ(CallOutcome::kTimeout, taken.get().outcome);
  answer(order, version2_frames::makePicture(test_pictures::makeNumbered(1), 0));
  EXPECT_THAT(pictures_, IsEmpty());
}

TEST_F(Version2SessionTest, ADamagedAnswerIsRequestedAgainWhileTimeIsLeft) {
  auto first = takePicture(10);
  auto second = takePicture(20, milliseconds(100));
  EXPECT_EQ("F 10 0", request());
  const Frame good = frame_;
  EXPECT_EQ("F 20 0", request());
  for (int i = 0; i < 2; ++i) {
    answer(version2_frames::makePicture(Bytes(5000, 7), 1));
    EXPECT_EQ("F 20 0", request());
  }
  pass(milliseconds(100));
  EXPECT_THAT(second.get().problem, HasSubstr("no picture within 100 ms; the last one was damaged: "));
  answer(good, version2_frames::makePicture(test_pictures::makeNumbered(1), 1));
  EXPECT_EQ(CallOutcome::kDone, first.get().outcome);
}

// ---- Telemetry

TEST_F(Version2SessionTest, TelemetryIsReportedInUnitsWithTheRobotsTime) {
  wish_.telemetry_period = 4;
  EXPECT_EQ("T 1 0 4", request());
  answer({0, 4});
  EXPECT_THAT(telemetry_, IsEmpty()) << "that was the period";
  const Bytes frame = makeFrame('t', 0,
                                version2_frames::makeTelemetry(99, {{'J', 2, -500000},
                                                                    {'S', 53, 250000},
                                                                    {'S', 14, 1},
                                                                    {'S', 5, 80000000},
                                                                    {'S', 200, -1},
                                                                    {'J', 52, 1000000},
                                                                    {'D', 52, -250000},
                                                                    {'D', 77, 1}}));
  const TimePoint first_byte_time = now_;
  receive(Bytes(frame.begin(), frame.begin() + 1));
  pass(milliseconds(10));
  receive(Bytes(frame.begin() + 1, frame.end()));
  ASSERT_THAT(telemetry_, SizeIs(1));
  const Telemetry& telemetry = telemetry_[0];
  EXPECT_EQ(99u, telemetry.frame_number);
  EXPECT_EQ(first_byte_time, telemetry.arrival);
  EXPECT_EQ(3u, telemetry.connection_number);
  ASSERT_THAT(telemetry.joints, SizeIs(2));
  EXPECT_EQ(2, telemetry.joints[0].id);
  EXPECT_DOUBLE_EQ(-0.5, telemetry.joints[0].position);
  EXPECT_FALSE(telemetry.joints[0].duty) << "not sent";
  EXPECT_EQ(-0.25, telemetry.joints[1].duty);
  ASSERT_THAT(telemetry.sensors, SizeIs(4));
  EXPECT_EQ(53, telemetry.sensors[0].id);
  EXPECT_DOUBLE_EQ(0.25, telemetry.sensors[0].value) << "range_near, m";
  EXPECT_DOUBLE_EQ(1, telemetry.sensors[1].value) << "paw_left_front, a switch";
  EXPECT_DOUBLE_EQ(80, telemetry.sensors[2].value) << "head_touch, a strength";
  EXPECT_DOUBLE_EQ(-1e-6, telemetry.sensors[3].value) << "a sensor of a newer robot";
  wish_.telemetry_period = 0x102;
  EXPECT_EQ("T 1 1 2", request()) << "another rate";
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

TEST_F(Version2SessionTest, OfTelemetryThatArrivedTogetherTheNewest64AreReportedInOrder) {
  receive(makeBurst(70));
  ASSERT_THAT(telemetry_, SizeIs(64));
  for (unsigned i = 0; i < 64; ++i) {
    EXPECT_EQ(28 + 4 * i, telemetry_[i].frame_number);
  }
  EXPECT_EQ(64u, counters_.telemetry);
  EXPECT_EQ(6u, counters_.dropped_telemetry);
}

TEST_F(Version2SessionTest, OnlyARobotThatWalksIsAskedHowItWalks) {
  pass(milliseconds(250));
  EXPECT_EQ("H 0", request());
  answer(version2_frames::makeHello("S"));
  EXPECT_DOUBLE_EQ(0.15, connection_.robot.walk_limits.forward);
  EXPECT_DOUBLE_EQ(0.1, connection_.robot.walk_limits.back);
  EXPECT_DOUBLE_EQ(0.06, connection_.robot.walk_limits.left);
  EXPECT_DOUBLE_EQ(1.2, connection_.robot.walk_limits.turn);
  wish_.telemetry_period = 4;
  EXPECT_EQ("T 3 0 4", request());
  answer({0, 4});
  push('t',
       version2_frames::makeTelemetry(
           99, {{'W', 1, 120000}, {'W', 2, -30000}, {'W', 3, 500000}, {'W', 4, 250000}, {'W', 5, 2}, {'W', 77, 1}}));
  ASSERT_THAT(telemetry_, SizeIs(1));
  ASSERT_TRUE(telemetry_[0].walk);
  EXPECT_DOUBLE_EQ(0.12, telemetry_[0].walk->velocity.forward);
  EXPECT_DOUBLE_EQ(-0.03, telemetry_[0].walk->velocity.left);
  EXPECT_DOUBLE_EQ(0.5, telemetry_[0].walk->velocity.turn);
  EXPECT_DOUBLE_EQ(0.25, telemetry_[0].walk->phase);
  EXPECT_EQ(WalkState::kWalks, telemetry_[0].walk->state);
  push('t', version2_frames::makeTelemetry(103, {{'W', 5, 9}, {'J', 1, 0}}));
  EXPECT_EQ(WalkState::kUnknown, telemetry_[1].walk->state);
  push('t', version2_frames::makeTelemetry(107, {{'J', 1, 0}}));
  EXPECT_FALSE(telemetry_[2].walk);
}

// ---- Commands

TEST_F(Version2SessionTest, JointsCommandedTogetherAreSentInOneRequest) {
  commandJoints({{2, -0.5}, {3, 0.25}}, milliseconds(300));
  EXPECT_EQ("J 0 1 44 2 0 2 0 0 0 255 248 94 224 3 0 0 0 0 3 208 144", request());
  Bytes accepted = frame_.payload;
  accepted.back() -= 144;  // 0.24987 rad
  answer(accepted);
  EXPECT_THAT(accepted_, ElementsAre("2=-0.500000 3=0.249856 ")) << "as the robot accepted it";
}

TEST_F(Version2SessionTest, NoMoreThanFourCommandsAreUnderWayAndThenTheLatestIsNext) {
  std::vector<Frame> sent;
  for (int i = 0; i < 4; ++i) {
    commandJoints({{2, 0.1 * i}});
    EXPECT_EQ('J', request()[0]);
    sent.push_back(frame_);
  }
  for (int i = 4; i < 100; ++i) {
    commandJoints({{2, 0.01 * i}});
    EXPECT_EQ("", request());
  }
  answer(sent[0], {0, 0, 0, 0});
  EXPECT_EQ("J 0 0 0 1 0 2 0 0 0 0 15 27 48", request()) << "0.99 rad";
  EXPECT_EQ("", request());
}

TEST_F(Version2SessionTest, SpeedLimitsGoFirstUnlessTheRobotHasThem) {
  commandJoints({{2, 0.5}});
  limitSpeed({{2, 0.75}, {3, 1}});
  EXPECT_EQ("V 0 2 0 0 0 0 11 113 176 3 0 0 0 0 15 66 64", request());
  EXPECT_EQ('J', request()[0]);
  limitSpeed({{2, 0.75}, {3, 1}});
  EXPECT_EQ("", request());
  limitSpeed({{2, 0.75}, {3, 2}});
  EXPECT_EQ("V 0 3 0 0 0 0 30 132 128", request());
  refuse("there is no joint 3");
  limitSpeed({{3, 2}});
  EXPECT_EQ("V 0 3 0 0 0 0 30 132 128", request()) << "it was refused";
}

TEST_F(Version2SessionTest, OfVelocitiesToWalkWithTheNewestIsSentWhenTheOneBeforeIsAnswered) {
  steer({0.15, -0.06, 1.2});
  EXPECT_EQ("S 0 0 150 255 196 4 176 0 0", request());
  for (int i = 0; i < 100; ++i) {
    steer({0.001 * i, 0, 0});
    EXPECT_EQ("", request());
  }
  EXPECT_THAT(steered_, IsEmpty());
  answer({0, 100, 0xff, 0xc4, 0x04, 0xb0, 0, 0});
  ASSERT_THAT(steered_, SizeIs(1));
  EXPECT_DOUBLE_EQ(0.1, steered_[0].forward) << "as the robot accepted it";
  EXPECT_DOUBLE_EQ(-0.06, steered_[0].left);
  EXPECT_DOUBLE_EQ(1.2, steered_[0].turn);
  EXPECT_THAT(steered_orders_, ElementsAre(kFirstOrder));
  EXPECT_EQ("S 0 0 99 0 0 0 0 0 0", request());
}

TEST_F(Version2SessionTest, LedsAreReportedAsTheRobotAcceptedThem) {
  commandLeds({{6, 1}, {7, 255, LedMode::kB}});
  EXPECT_EQ("L 0 6 1 0 0 7 255 1 0", request());
  answer({6, 255, 0, 0, 7, 200, 1, 0});
  EXPECT_EQ("6=255A 7=200B ", leds_);
  commandLeds({{99, 1}});
  request();
  refuse("there is no LED 99");
  EXPECT_EQ("6=255A 7=200B ", leds_) << "what was refused is not reported";
}

TEST_F(Version2SessionTest, LedsAndEarsWaitForTheAnswerBeforeAndThenTheLatestIsNext) {
  commandLeds({{7, 1}});
  EXPECT_EQ("L 0 7 1 0 0", request());
  const Frame leds = frame_;
  commandEars(true, false);
  EXPECT_EQ("K 0 1 0", request());
  for (int i = 0; i < 100; ++i) {
    commandLeds({{7, i}});
    commandEars(false, i % 2 != 0);
    EXPECT_EQ("", request());
  }
  refuse("the ears are stuck");
  EXPECT_EQ("K 0 0 1", request());
  answer(leds, {7, 1, 0, 0});
  EXPECT_EQ("L 0 7 99 0 0", request());
}

// ---- Refusals

TEST_F(Version2SessionTest, ARefusalIsLoggedIfNobodyIsTold) {
  commandLeds({{99, 1}});
  request();
  refuse("there is no LED 99");
  EXPECT_EQ(1, logged("refused to set LEDs: there is no LED 99"));
}

TEST_F(Version2RefusalsTest, WhatTheRobotRefusesIsToldWithItsOrderAndItsParts) {
  commandJoints({{2, 0.5}, {1, -0.1}});
  steer({0.1, 0, 0});
  limitSpeed({{3, 1}, {2, 5}});
  commandLeds({{7, 255}, {3, 1}});
  commandEars(true, false);
  for (const char letter : {'V', 'S', 'J', 'L', 'K'}) {
    EXPECT_EQ(letter, request()[0]);
    refuse(std::string("no ") + letter);
  }
  expectRefusals({{RefusedRequest::kSpeedLimits, RefusalCause::kRobot, {3, 2}, "no V", 0},
                  {RefusedRequest::kWalk, RefusalCause::kRobot, {}, "no S", kFirstOrder + 1},
                  {RefusedRequest::kJoints, RefusalCause::kRobot, {2, 1}, "no J", kFirstOrder},
                  {RefusedRequest::kLeds, RefusalCause::kRobot, {7, 3}, "no L", 0},
                  {RefusedRequest::kEars, RefusalCause::kRobot, {1, 2}, "no K", 0}});
  EXPECT_EQ(5u, counters_.refusals);
  EXPECT_THAT(log_, IsEmpty());
}

TEST_F(Version2RefusalsTest, AJointThatDoesNotFollowIsNamed) {
  const std::string jam = "left_front_knee is jammed: its motor pushes and it does not move";
  const std::string motion = "NOD.MTN is stopped: tail_pan and head_pan do not follow";
  push('e', version2_frames::makeError(3, jam));
  push('e', version2_frames::makeError(3, motion));
  expectRefusals({{RefusedRequest::kJoints, RefusalCause::kJointFault, {13}, jam, 0},
                  {RefusedRequest::kJoints, RefusalCause::kJointFault, {2, 51}, motion, 0}});
}

// ---- What goes first, and what is dropped

TEST(Version2Session, SendsAnOrderToStopBeforeEverythingElse) {
  for (const char letter : {'I', 'O'}) {
    NewSession session;
    session.pass(milliseconds(250));  // a heartbeat would be due
    session.wish_ = {true, 73, 4};
    session.commandJoints({{2, 0.1}});
    session.limitSpeed({{2, 1.0}});
    session.commandLeds({{1, 255}});
    auto picture = session.takePicture(10);
    auto motors = session.add(callForMotors(true));
    auto upload = session.add(callToStore("NOD.MTN", {1, 2, 3}, 0));
    auto stop = session.add(letter == 'I' ? callToHold({}) : callForMotors(false));
    EXPECT_EQ(letter == 'I' ? "I 0" : "O 0 0", session.request());
    session.answer(session.frame_.payload);
    EXPECT_EQ(CallOutcome::kDone, stop.get().outcome);
    EXPECT_EQ("WFVOUTL", session.requests()) << "without J, which came before";
  }
}

TEST(Version2Session, DropsWaitingOrdersAsInThisTable) {
  using Order = std::function<std::future<Answer>(NewSession&)>;
  const auto command = [](const std::function<void(NewSession&)>& give) {
    return [give](NewSession& session) { return give(session), std::future<Answer>(); };
  };
  const std::pair<std::string, Order> waiting[] = {
      {"joint 2", command([](NewSession& session) {
         session.commandJoints({{2, 0.1}});
       })},
      {"joint 11, of a leg", command([](NewSession& session) {
         session.commandJoints({{11, 0.1}});
       })},
      {"walk", command([](NewSession& session) {
         session.steer({0.1, 0, 0});
       })},
      {"motion NOD", [](NewSession& session) { return session.add(callToPlay("NOD.MTN", 1, 0)); }},
      {"posture", [](NewSession& session) { return session.add(callForPosture(version2::POSTURE_SIT)); }},
  };
  const struct {
    std::string order;
    Order give;
    std::string dropped;  // x: this order of `waiting` is not carried out
  } rows[] = {
      {"hold everything", [](NewSession& session) { return session.add(callToHold({})); }, "xxxxx"},
      {"hold joint 2", [](NewSession& session) { return session.add(callToHold({2})); }, "x--xx"},
      {"hold joint 11",
       [](NewSession& session) {
         return session.add(callToHold({3, 11}));
       },
       "-xxxx"},
      {"motors off", [](NewSession& session) { return session.add(callForMotors(false)); }, "xxxxx"},
      {"motors on", [](NewSession& session) { return session.add(callForMotors(true)); }, "xx---"},
      {"posture", [](NewSession& session) { return session.add(callForPosture(version2::POSTURE_STAND)); }, "xxx--"},
      {"play SIT", [](NewSession& session) { return session.add(callToPlay("SIT.MTN", 1, 0)); }, "xx---"},
      {"stop NOD", [](NewSession& session) { return session.add(callToStop("NOD.MTN")); }, "---x-"},
      {"stop SIT", [](NewSession& session) { return session.add(callToStop("SIT.MTN")); }, "-----"},
      {"stop all motions", [](NewSession& session) { return session.add(callToStop("")); }, "---x-"},
      {"walk", command([](NewSession& session) {
         session.steer({0.2, 0, 0});
       }),
       "-x---"},
  };
  for (const auto& row : rows) {
    std::string dropped;
    for (const auto& [name, wait] : waiting) {
      NewSession session;
      const std::future<Answer> answer = wait(session);
      const std::future<Answer> other = row.give(session);
      session.requests();
      dropped += !session.refusals_.empty() || (answer.valid() && session.done(answer)) ? "x" : "-";
    }
    EXPECT_EQ(row.dropped, dropped) << row.order;
  }
}

TEST_F(Version2RefusalsTest, WhatAStopComesBeforeIsToldWithTheReason) {
  auto posture = add(callForPosture(version2::POSTURE_SIT));
  commandJoints({{2, 0.5}, {3, 0.5}});
  auto held = add(callToHold({2}));
  expectRefusals({{RefusedRequest::kJoints,
                   RefusalCause::kStopped,
                   {2},
                   "the robot was told to hold its joints before it was sent",
                   kFirstOrder}});
  EXPECT_EQ("robot:54321 was told to hold its joints before it was asked to take the posture sit.",
            posture.get().problem);
  EXPECT_EQ("I 1 2", request());
  EXPECT_EQ("J 0 0 0 1 0 3 0 0", request(7)) << "without joint 2";
}

TEST_F(Version2SessionTest, OneRequestForTheMemoryStickIsSentAtATimeAndTheOthersGoOn) {
  auto play = add(callToPlay("NOD.MTN", 1, 0));
  auto list = add(callForMotions(), milliseconds(200));
  auto erase = add(callToDelete("NOD.MTN"));
  auto motors = add(callForMotors(true));
  EXPECT_EQ('P', request()[0]);
  const Frame sent = frame_;
  EXPECT_EQ('O', request()[0]);
  EXPECT_EQ("", request());
  answer(sent, {});
  EXPECT_EQ("N 0", request());
  EXPECT_EQ("", request());
  pass(milliseconds(200));
  EXPECT_EQ("D", requests()) << "the one before was not answered in time";
}

// ---- Calls that time out

TEST_F(Version2SessionTest, ALateAnswerToANumberedCallIsTold) {
  std::vector<Frame> sent;
  for (const std::uint64_t number : {7, 8, 0}) {
    Call call = callToPlay("NOD.MTN", 1, 0);
    call.order = number;
    auto play = add(std::move(call), milliseconds(1000));
    EXPECT_EQ('P', request()[0]);
    sent.push_back(frame_);
    live(milliseconds(1000));
    const Answer nothing = play.get();
    EXPECT_EQ("no answer within 1000 ms. The robot may or may not play the motion NOD.MTN.", nothing.problem);
    EXPECT_TRUE(nothing.was_sent);
  }
  refuse(sent[1], "there is no NOD.MTN", 1);
  answer(sent[0], {'c', 'l', 'i', 'p'});
  answer(sent[0], {});
  answer(sent[2], {});
  ASSERT_THAT(late_answers_, SizeIs(2)) << "once each, and none without a number";
  EXPECT_EQ(8u, late_answers_[0].order);
  EXPECT_FALSE(late_answers_[0].accepted);
  EXPECT_THAT(late_answers_[0].reason, HasSubstr("there is no NOD.MTN"));
  EXPECT_EQ(7u, late_answers_[1].order);
  EXPECT_TRUE(late_answers_[1].accepted);
  EXPECT_EQ("clip", late_answers_[1].changes);
}

TEST_F(Version2SessionTest, AnOrderThatCouldNotBeSentInTimeIsNotSentLater) {
  auto upload = add(callToStore("NOD.MTN", {1, 2, 3}, 0), milliseconds(10000));
  EXPECT_EQ('U', request()[0]);
  const Frame sent = frame_;
  auto short_call = add(callToPlay("SIT.MTN", 1, 0), milliseconds(100));
  Call call = callToPlay("SIT.MTN", 1, 0);
  call.not_after = now_ + milliseconds(150);
  auto old_order = add(std::move(call), milliseconds(5000));
  EXPECT_EQ("", request());
  pass(milliseconds(149));
  const Answer short_answer = short_call.get();
  EXPECT_EQ(CallOutcome::kTimeout, short_answer.outcome);
  EXPECT_EQ("the request could not be sent within 100 ms.", short_answer.problem);
  EXPECT_FALSE(short_answer.was_sent);
  EXPECT_FALSE(done(old_order));
  pass(milliseconds(1));
  const Answer old_answer = old_order.get();
  EXPECT_EQ(CallOutcome::kRefused, old_answer.outcome);
  EXPECT_EQ("The order to play the motion SIT.MTN is too old: it could not be sent to robot:54321 in time.",
            old_answer.problem);
  answer(sent, {});
  EXPECT_EQ("", request());
}

TEST_F(Version2SessionTest, BehindALargeUploadAnswersAndPicturesMayBeLate) {
  stream();
  auto upload = add(callToStore("NOD.MTN", Bytes(65523), 0), milliseconds(20000));
  EXPECT_EQ('U', request(0)[0]);
  std::vector<Frame> sent = {frame_};
  for (int i = 0; i < 7; ++i) {
    pass(milliseconds(250));
    EXPECT_EQ("H 0", request());
    sent.push_back(frame_);
  }
  pass(milliseconds(150));
  answer(sent[0], {});
  for (int i = 1; i <= 7; ++i) {
    answer(sent[static_cast<std::size_t>(i)], version2_frames::makeHello());
  }
  live(milliseconds(499));
  EXPECT_EQ(kSilentStream, whyGivenUp([this] { live(milliseconds(1)); }))
      << "it has been answered, so pictures are due again";
}

TEST_F(Version2SessionTest, AfterALargeUploadThatWasRefusedPicturesAreDueAsEver) {
  stream();
  auto upload = add(callToStore("NOD.MTN", Bytes(65523), 0), milliseconds(20000));
  EXPECT_EQ('U', request(0)[0]);
  refuse("the memory stick is full");
  live(milliseconds(499));
  EXPECT_EQ(kSilentStream, whyGivenUp([this] { live(milliseconds(1)); }));
}

TEST_F(Version2SessionTest, BehindALargeFileAnswersMayBeLateButNotForEver) {
  auto fetch = add(callToFetchPicture("AIBO0001.JPG"), milliseconds(20000));
  EXPECT_EQ('Y', request()[0]);
  for (int i = 0; i < 19; ++i) {  // the largest file may take 4 s
    request();
    pass(milliseconds(250));
  }
  request();
  EXPECT_THAT(whyGivenUpWithin(milliseconds(250)), HasSubstr("did not answer the request 'H' within"));
}

// ---- What the robot reports

TEST_F(Version2SessionTest, TheRobotIsAskedForItsMotorsAndTellsOfThemFromThenOn) {
  pass(milliseconds(250));
  EXPECT_EQ("H 0", request());
  answer(version2_frames::makeHello("O"));
  EXPECT_EQ("O 0", request());
  answer({1});
  EXPECT_EQ("", request());
  EXPECT_EQ(MotorState::kUnknown, connection_.motors_and_posture.motors) << "an older server does not tell of changes";
  push('o', {1, version2::POSTURE_SIT, 0, 0});
  EXPECT_EQ(MotorState::kOn, connection_.motors_and_posture.motors);
  EXPECT_EQ(PostureNow::kSitting, connection_.motors_and_posture.posture);
  push('o', {0, 77, 0, 0});
  EXPECT_EQ(MotorState::kOff, connection_.motors_and_posture.motors);
  EXPECT_EQ(PostureNow::kUnknown, connection_.motors_and_posture.posture) << "of a newer server";
}

TEST_F(Version2SessionTest, EveryKindAndWayOfEndIsToldAndThoseOfANewerServerAreUnknown) {
  const EndedKind kinds[] = {EndedKind::kUnknown, EndedKind::kMotion, EndedKind::kWalk,
                             EndedKind::kPosture, EndedKind::kJam,    EndedKind::kUnknown};
  const EndedHow hows[] = {EndedHow::kDone,    EndedHow::kReplaced, EndedHow::kStopped,
                           EndedHow::kRefused, EndedHow::kFell,     EndedHow::kUnknown};
  for (int i = 0; i < 6; ++i) {
    push('i', version2_frames::makeEnd(i, i, "NOD.MTN", "told to"));
    EXPECT_EQ("NOD.MTN: told to", ended_.back().name + ": " + ended_.back().reason);
    EXPECT_EQ(kinds[i], ended_.back().kind) << i;
    EXPECT_EQ(hows[i], ended_.back().how) << i;
  }
}

TEST_F(Version2SessionTest, TextsAreCutAt512BytesBetweenCharacters) {
  const auto report = [this](char kind, Bytes payload, const std::string& text) {
    payload.insert(payload.end(), text.begin(), text.end());
    push(kind, payload);
  };
  const std::string most(511, 'x');
  report('e', {0, 3}, most + "\xc3\xa9" + std::string(60000, 'y'));
  EXPECT_EQ(most + "...", connection_.robot_message);
  report('e', {0, 3}, most + "x");
  EXPECT_EQ(most + "x", connection_.robot_message);
  report('i', {1, 0, 0, 0}, std::string(60000, 'x') + "\n" + std::string(60000, 'y'));
  EXPECT_EQ(std::string(512, 'x') + "...", ended_[0].name);
  EXPECT_EQ(std::string(512, 'y') + "...", ended_[0].reason);
}

TEST_F(Version2SessionTest, ReportsOfAJointAreOverWhenItFollowsAgain) {
  const auto follows = [this](const std::string& joint) {
    push('i', version2_frames::makeEnd(version2::ENDED_JAM, version2::END_DONE, joint, ""));
    return connection_.robot_message;
  };
  for (const char* const joint : {"mouth", "tail_tilt", "mouth"}) {
    push('e', version2_frames::makeError(3, joint + std::string(" is jammed")));
  }
  push('e', version2_frames::makeError(3, "NOD.MTN is stopped: head_pan does not follow."));
  EXPECT_EQ("NOD.MTN is stopped: head_pan does not follow.", follows("head")) << "not its name";
  EXPECT_EQ("mouth is jammed", follows("head_pan"));
  EXPECT_EQ("tail_tilt is jammed", follows("mouth"));
  EXPECT_EQ("", follows("tail_tilt"));
  push('e', version2_frames::makeError(4, "the battery below the mouth is low"));
  EXPECT_EQ("the battery below the mouth is low", follows("mouth")) << "no joint's fault";
  EXPECT_EQ(2, logged("The joint mouth follows its commands again."));
}

}  // namespace
