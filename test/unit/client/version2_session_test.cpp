// A session of version 2: docs/protocol.md, "Version 2", and rcserver_client.h.
#include "client/version2_session.h"

#include "client/fault.h"
#include "protocol/big_endian.h"
#include "protocol/motion_requests.h"
#include "version2_fixture.h"

using namespace aibo_client;
using namespace test_support;
using std::chrono::milliseconds;
using test_pictures::Bytes;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using version2_frames::makeFrame;

namespace version2 = protocol::version2;

namespace {

class Version2SessionTest : public Version2SessionFixture {
 public:
  Version2SessionTest() { begin("F W J V T S"); }
};

/// For the rows of tables.
struct NewSession : public Version2SessionTest {
  void TestBody() override {}
};

TEST_F(Version2SessionTest, TheHelloIntroducesTheRobot) {
  const RobotInfo& robot = connection_.status.robot;
  EXPECT_EQ("ERS-7", robot.design);
  EXPECT_EQ("a test 1.0", robot.server);
  EXPECT_TRUE(robot.hasCapability("J"));
  EXPECT_FALSE(robot.hasCapability("Z"));
  ASSERT_THAT(robot.joint_limits, SizeIs(2));
  EXPECT_EQ(2, robot.joint_limits[1].id);
  EXPECT_DOUBLE_EQ(-1.5, robot.joint_limits[1].lower);
  EXPECT_DOUBLE_EQ(1.6, robot.joint_limits[1].upper);
  EXPECT_DOUBLE_EQ(10, robot.joint_limits[1].speed);
  EXPECT_DOUBLE_EQ(0.15, robot.walk_limits.forward);
  EXPECT_DOUBLE_EQ(0.1, robot.walk_limits.back);
  EXPECT_DOUBLE_EQ(0.06, robot.walk_limits.left);
  EXPECT_DOUBLE_EQ(1.2, robot.walk_limits.turn);
}

TEST_F(Version2SessionFixture, NothingIsAskedForBeforeTheHelloIsAnswered) {
  Connection connection({"robot:54321", milliseconds(1700), notifier_, counters_}, now_);
  Version2Session session(connection, now_);
  wanted_ = {true, 85, 4};
  EXPECT_FALSE(session.nextRequest(wanted_, now_).empty());
  Call stop = callToHold({});
  stop.deadline = now_ + milliseconds(5000);
  connection.add(std::move(stop));
  EXPECT_TRUE(session.nextRequest(wanted_, now_).empty()) << "not even for a stop";
  EXPECT_FALSE(session.ready());
  EXPECT_NO_THROW(session.checkDeadlines(now_ + milliseconds(1699))) << "an answer has as much time as a picture";
  EXPECT_THROW(session.checkDeadlines(now_ + milliseconds(1700)), Fault);
}

TEST_F(Version2SessionTest, SaysHelloEachSecondWhateverElseIsSentAndWhenItIsAskedTo) {
  for (int second = 0; second < 3; ++second) {
    pass(milliseconds(999));
    steer({});
    EXPECT_EQ("S", requests());
    answer(Bytes(8));
    pass(milliseconds(1));
    EXPECT_EQ("H 0", request());
    answer(version2_frames::makeHello());
  }
  push('h', {});
  EXPECT_EQ("H", requests());
  push('h', {});
  EXPECT_EQ("H", requests()) << "though the one before is not answered";
}

TEST_F(Version2SessionTest, AServerThatDoesNotAnswerTheHeartbeatIsGivenUp) {
  pass(milliseconds(1000));
  EXPECT_EQ("H 0", request());
  pass(milliseconds(999));
  EXPECT_EQ("robot:54321 did not answer the request 'H' within 1000 ms", whyGivenUpWithin(milliseconds(1)));
}

TEST(Version2Session, EndsIfTheServerSendsWhatNoneSends) {
  const std::pair<Bytes, std::string> pushes[] = {
      {Bytes(8, 0), "a frame that begins with byte 0"},
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
    char request;
    char kind;  // of the request that the reply belongs to
    Bytes payload;
    std::string problem;
  } replies[] = {
      {'S', 'S', {0, 100, 0, 0, 0, 0}, "bad reply to steering"},
      {'L', 'L', {7, 1, 9, 0}, "bad "},
      {'S', 'V', {}, "a reply 'v' to the request 'S'"},
  };
  for (const auto& row : replies) {
    NewSession session;
    session.steer({});
    session.commandLeds({{7, 1}});
    while (session.request()[0] != row.request) {
    }
    session.frame_.header.kind = row.kind;
    EXPECT_THAT(SessionFixture::whyGivenUp([&] { session.answer(row.payload); }), HasSubstr(row.problem));
  }
}

TEST_F(Version2SessionTest, PushesOfUnknownKindsAndRepliesToUnknownNumbersAreIgnored) {
  receive(makeFrame('x', 0, {1, 2, 3}));
  receive(makeFrame('j', 4711, {1, 2, 3}));
  receive(makeFrame('e', 4711, version2_frames::makeError(0, "too late")));
  EXPECT_THAT(log_, IsEmpty());
}

TEST_F(Version2SessionTest, AStreamThatIsSilentIsGivenUpThoughTheHeartbeatIsAnswered) {
  live(milliseconds(600));  // a stream that begins late has as much time
  stream();
  live(milliseconds(499));
  pushPicture(1);
  live(milliseconds(499));
  EXPECT_EQ(kSilentStream, whyGivenUp([this] { live(milliseconds(1)); }));
}

TEST_F(Version2SessionTest, PicturesHaveTheirNumbersAndTwoThatCameTogetherAre1NsApart) {
  stream();
  const Bytes picture = makeFrame('f', 0, version2_frames::makePicture(test_pictures::makeNumbered(1), 4711));
  Bytes both = picture;
  both.insert(both.end(), picture.begin(), picture.end());
  receive(both);
  ASSERT_THAT(pictures_, SizeIs(2));
  EXPECT_EQ(test_pictures::makeNumbered(1), pictures_[0]->jpeg);
  EXPECT_EQ(4711u, pictures_[0]->frame_number);
  EXPECT_EQ(version2_frames::kImageCount, pictures_[0]->image_count);
  EXPECT_EQ(208, pictures_[0]->width);
  EXPECT_EQ(85, pictures_[0]->quality);
  EXPECT_EQ(3u, pictures_[0]->connection_number);
  EXPECT_EQ(now_, pictures_[0]->first_byte_time);
  EXPECT_EQ(now_ + std::chrono::nanoseconds(1), pictures_[1]->first_byte_time);
}

TEST_F(Version2SessionTest, APictureThatHasWaitedForTheClientsThreadIsNotDelivered) {
  stream();
  now_ += milliseconds(150);
  pushPicture(1);
  EXPECT_THAT(pictures_, IsEmpty());
  EXPECT_EQ(1u, counters_.stale_pictures);
}

TEST_F(Version2SessionTest, PicturesOfAStoppedStreamAreDroppedAndAFaultIfTheyDoNotEnd) {
  stream();
  wanted_.streaming = false;
  request();
  answer(frame_.payload);
  pushPicture(1);
  EXPECT_THAT(pictures_, IsEmpty());
  EXPECT_EQ(1u, counters_.unexpected_pictures);
  live(milliseconds(1100));
  EXPECT_THAT(whyGivenUp([this] { pushPicture(2); }), HasSubstr("it sends pictures although it was told to stop"));
}

TEST_F(Version2SessionTest, DuringTheStreamEachCallerGetsItsOwnPictureInAnyOrder) {
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
  EXPECT_THAT(pictures_, SizeIs(3));
}

TEST_F(Version2SessionTest, ThePictureOfACallThatHasTimedOutIsDropped) {
  auto taken = takePicture(10, milliseconds(300));
  EXPECT_EQ("F 10 0", request());
  const Frame order = frame_;
  live(milliseconds(300));
  EXPECT_EQ(CallOutcome::kTimeout, taken.get().outcome);
  answer(order, version2_frames::makePicture(test_pictures::makeNumbered(1), 0));
  EXPECT_THAT(pictures_, IsEmpty());
}

TEST_F(Version2SessionTest, ADamagedAnswerIsRequestedAgainWhileTimeIsLeft) {
  auto taken = takePicture(20, milliseconds(100));
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ("F 20 0", request());
    answer(version2_frames::makePicture(Bytes(5000, 7), 1));
  }
  pass(milliseconds(100));
  EXPECT_THAT(taken.get().problem, HasSubstr("no picture within 100 ms; the last one was damaged: "));
}

TEST_F(Version2SessionTest, TelemetryIsReportedInUnitsWithTheRobotsTime) {
  wanted_.telemetry_period = 4;
  EXPECT_EQ("T 1 0 4", request());
  answer({0, 4});
  EXPECT_THAT(telemetry_, IsEmpty()) << "that was the period";
  const Bytes frame = makeFrame(
      't', 0,
      version2_frames::makeTelemetry(
          99, {{'J', 2, -500000}, {'S', 53, 250000}, {'S', 200, -1}, {'J', 52, 1000000}, {'D', 52, -250000}}));
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
  ASSERT_THAT(telemetry.sensors, SizeIs(2));
  EXPECT_EQ(53, telemetry.sensors[0].id);
  EXPECT_DOUBLE_EQ(0.25, telemetry.sensors[0].value);
  EXPECT_DOUBLE_EQ(-1e-6, telemetry.sensors[1].value) << "a sensor of a newer robot";
  wanted_.telemetry_period = 0x102;
  EXPECT_EQ("T 1 1 2", request()) << "another rate";
}

TEST_F(Version2SessionTest, TelemetryThatArrivedTogetherIsReportedInOrder) {
  Bytes burst;
  for (unsigned i = 1; i <= 64; ++i) {
    const Bytes each = makeFrame('t', 0, version2_frames::makeTelemetry(4 * i, {{'J', 1, 1000}}));
    burst.insert(burst.end(), each.begin(), each.end());
  }
  receive(burst);
  ASSERT_THAT(telemetry_, SizeIs(64));
  for (unsigned i = 0; i < 64; ++i) {
    EXPECT_EQ(4 + 4 * i, telemetry_[i].frame_number);
  }
}

TEST_F(Version2SessionTest, ARobotThatWalksTellsHow) {
  wanted_.telemetry_period = 4;
  EXPECT_EQ("T 1 0 4", request());
  answer({0, 4});
  push('t', version2_frames::makeTelemetry(
                99, {{'W', 1, 120000}, {'W', 2, -30000}, {'W', 3, 500000}, {'W', 4, 250000}, {'W', 77, 1}}));
  ASSERT_TRUE(telemetry_.at(0).walk);
  EXPECT_DOUBLE_EQ(0.12, telemetry_[0].walk->velocity.forward);
  EXPECT_DOUBLE_EQ(-0.03, telemetry_[0].walk->velocity.left);
  EXPECT_DOUBLE_EQ(0.5, telemetry_[0].walk->velocity.turn);
  EXPECT_DOUBLE_EQ(0.25, telemetry_[0].walk->phase);
  push('t', version2_frames::makeTelemetry(103, {{'J', 1, 0}}));
  EXPECT_FALSE(telemetry_[1].walk);
  const std::pair<int, WalkState> states[] = {{0, WalkState::kNone},
                                              {1, WalkState::kGetsReady},
                                              {2, WalkState::kWalks},
                                              {3, WalkState::kUnknown},
                                              {-1, WalkState::kUnknown}};
  unsigned frame = 107;
  for (const auto& [number, state] : states) {
    push('t', version2_frames::makeTelemetry(frame += 4, {{'W', 5, number}}));
    EXPECT_EQ(state, telemetry_.back().walk->state) << number;
  }
}

TEST_F(Version2SessionTest, JointsCommandedTogetherAreSentInOneRequest) {
  commandJoints({{2, -0.5}, {3, 0.25}}, milliseconds(300));
  EXPECT_EQ("J 0 0 0 0 52 1 44 2 0 2 0 0 0 255 248 94 224 3 0 0 0 0 3 208 144", request());
  Bytes accepted(frame_.payload.begin() + 4, frame_.payload.end());
  accepted.back() -= 144;  // 0.24987 rad
  answer(accepted);
  EXPECT_THAT(accepted_, testing::ElementsAre("2=-0.500000 3=0.249856 ")) << "as the robot accepted it";
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
  EXPECT_EQ("J 0 0 0 0 52 0 0 1 0 2 0 0 0 0 15 27 48", request()) << "0.99 rad";
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

TEST_F(Version2SessionTest, TheNewestVelocityIsSentWhenTheOneBeforeIsAnswered) {
  steer({0.15, -0.06, 1.2});
  EXPECT_EQ("S 0 0 0 0 52 0 150 255 196 4 176 0 0", request());
  for (int i = 1; i < 100; ++i) {
    steer({0.001 * i, 0, 0});
    EXPECT_EQ("", request());
  }
  EXPECT_THAT(steered_, IsEmpty());
  answer({0, 100, 0xff, 0xc4, 0x04, 0xb0, 0, 0});
  ASSERT_THAT(steered_, SizeIs(1));
  EXPECT_DOUBLE_EQ(0.1, steered_[0].forward) << "as the robot accepted it";
  EXPECT_DOUBLE_EQ(-0.06, steered_[0].left);
  EXPECT_DOUBLE_EQ(1.2, steered_[0].turn);
  EXPECT_THAT(steered_orders_, testing::ElementsAre(std::make_pair(kFirstOrder, 0)));
  EXPECT_EQ("S 0 0 0 0 52 0 99 0 0 0 0 0 0", request());
}

TEST_F(Version2SessionTest, LedsAreReportedAsTheRobotAcceptedThem) {
  commandLeds({{6, 1}, {7, 255, LedMode::kB}});
  EXPECT_EQ("L 0 6 1 0 0 7 255 1 0", request());
  answer({6, 255, 0, 0, 7, 200, 1, 0});
  EXPECT_EQ("6=255A 7=200B ", leds_);
}

TEST_F(Version2SessionTest, LedsAndEarsWaitForTheAnswerBeforeAndThenTheLatestIsNext) {
  for (int i = 0; i < 10; ++i) {
    commandLeds({{7, i}});
    commandEars(false, i % 2 != 0);
    EXPECT_EQ(i == 0 ? "LK" : "", requests());
  }
  refuse("the ears are stuck");
  EXPECT_EQ("K 0 0 1", request());
  EXPECT_EQ("", request()) << "the LEDs still wait";
}

/// All kinds of orders, with a velocity of 0 before.
void giveAllOrders(NewSession* session, std::vector<std::future<Answer>>* answers) {
  const auto order = [&](Call call) { answers->push_back(session->order(std::move(call))); };
  order(callForPosture(Posture::kSit));
  order(callToPlay("NOD.MTN"));
  order(callForMotors(true));
  session->steer({});
  session->steer({0.1, 0, 0});
  session->commandJoints({{2, 0.1}});
}

TEST(Version2Session, TellsUntilWhichFrameAnOrderIsGood) {
  constexpr unsigned kLast = 0xFFFFFFFF;
  const struct {
    unsigned frame;     // as told
    milliseconds age;   // the message with the frame
    milliseconds wait;  // how long the order is good
    unsigned not_after;
  } rows[] = {
      {1000, milliseconds(0), milliseconds(500), 1062},
      {1000, milliseconds(0), milliseconds(0), 1000},
      {1000, milliseconds(7), milliseconds(7), 1000},
      {1000, milliseconds(2000), milliseconds(500), 1312},
      {kLast - 62, milliseconds(0), milliseconds(500), 0},  // the last number means that it never is too old
      {kLast - 63, milliseconds(0), milliseconds(500), kLast - 1},
      {kLast - 61, milliseconds(0), milliseconds(500), 0},
      {kLast - 60, milliseconds(0), milliseconds(500), 1},
      {1000, milliseconds(0), std::chrono::hours(1000000), 1000 + (1 << 30)},
  };
  for (const auto& row : rows) {
    NewSession session;
    session.push('t', version2_frames::makeTelemetry(row.frame, {}));
    session.now_ += milliseconds(1100);  // what came before does not count any more
    session.push('t', version2_frames::makeTelemetry(row.frame, {}));
    session.now_ += row.age;
    session.connection_.commands.steer({{0.1, 0, 0}, {session.now_ + row.wait, 1}});
    while (session.request()[0] != 'S') {
    }
    EXPECT_EQ(row.not_after, protocol::decodeBigEndian32(session.frame_.payload.data())) << row.not_after;
  }
}

TEST(Version2Session, SendsTheExpiryOfEachKindOfOrder) {
  NewSession session;  // it had the frame kFrame
  std::vector<std::future<Answer>> answers;
  giveAllOrders(&session, &answers);
  std::string kinds;
  for (std::string each = session.request(); !each.empty(); each = session.request()) {
    EXPECT_EQ(kFrame + 62, protocol::decodeBigEndian32(session.frame_.payload.data())) << each;
    kinds += each[0];
    if (each[0] == 'S') {
      session.answer(Bytes(8));
    }
  }
  EXPECT_EQ("SEPOSJ", kinds);
}

TEST(Version2Session, SendsNoOrderWithoutAFrameOfTheLast2S) {
  NewSession session;
  std::vector<std::future<Answer>> answers;
  session.now_ += milliseconds(2001);
  EXPECT_EQ("H", session.requests());
  giveAllOrders(&session, &answers);
  EXPECT_EQ("S", session.requests()) << "a velocity of 0";
  session.answer(Bytes(8));
  auto stop = session.add(callToStop(""));
  EXPECT_EQ("P", session.requests()) << "a stop";
  session.pass(milliseconds(490));
  session.push('t', version2_frames::makeTelemetry(5, {}));
  EXPECT_EQ("EOSJ", session.requests());
  NewSession other;
  other.stream();
  other.now_ += milliseconds(2001);
  giveAllOrders(&other, &answers);
  other.pushPicture(1, 300);
  EXPECT_EQ("SHEPOJ", other.requests()) << "a picture tells the frame, too";
}

TEST(Version2Session, TakesALateMessageForAnEarlierFrameAndATimelyOneAtOnce) {
  NewSession session;
  const auto present = [&session] {
    session.commandJoints({{2, 0.1}});
    while (session.request()[0] != 'J') {
    }
    const unsigned not_after = protocol::decodeBigEndian32(session.frame_.payload.data());
    session.answer({0, 0, 0, 0});
    return not_after - 62;
  };
  const auto told = [&session](unsigned frame) { session.push('t', version2_frames::makeTelemetry(frame, {})); };
  told(1000);
  EXPECT_EQ(1000u, present());
  session.now_ += milliseconds(800);  // 100 frames
  told(1090);
  EXPECT_EQ(1100u, present()) << "better is known";
  session.now_ += milliseconds(208);  // of 26 frames
  told(1100);
  EXPECT_EQ(1100u, present()) << "what is known is 1 s old";
  told(1126);
  EXPECT_EQ(1126u, present());
}

TEST_F(Version2SessionTest, EachOrderEndsOnceByItsNumber) {
  const auto end = [this](int what, int number) {
    push('i', version2_frames::makeEnd(what, version2::END_DONE, "", "", number));
    return ended_.back().order;
  };
  auto posture = order(callForPosture(Posture::kSit), milliseconds(100));
  auto motion = order(callToPlay("NOD.MTN"), milliseconds(100));
  commandJoints({{2, 0.1}});
  std::vector<int> numbers;
  for (const char letter : {'E', 'P', 'J'}) {
    EXPECT_EQ(letter, request()[0]);
    numbers.push_back(frame_.header.request_number);
  }
  answer({0, 0, 0, 0});
  pass(milliseconds(100));
  EXPECT_TRUE(posture.get().was_sent);
  receive(makeFrame('e', numbers[0], {}));  // the answer comes nevertheless
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(kFirstOrder + static_cast<unsigned>(i), end(i + 1, numbers[static_cast<std::size_t>(i)]));
    EXPECT_EQ(0u, end(i + 1, numbers[static_cast<std::size_t>(i)])) << "it has ended";
  }
  EXPECT_EQ(0u, end(version2::ENDED_JAM, 0));
  expectRefusals({});
}

TEST_F(Version2SessionTest, AnOrderIsRefusedByItsNumberAlsoIfNobodyWaits) {
  using Kind = RefusedRequest;
  for (const int code : {0, 5}) {
    const RefusalCause cause = code == 5 ? RefusalCause::kTooOld : RefusalCause::kRobot;
    auto posture = order(callForPosture(Posture::kSit));
    auto motion = order(callToPlay("NOD.MTN"), milliseconds(100));
    auto unnumbered = add(callForPosture(Posture::kRest));
    steer({0.1, 0, 0});
    std::vector<Frame> sent;
    for (const char letter : {'E', 'P', 'E', 'S'}) {
      EXPECT_EQ(letter, request()[0]);
      sent.push_back(frame_);
    }
    pass(milliseconds(100));
    EXPECT_EQ(CallOutcome::kTimeout, motion.get().outcome);
    for (const Frame& each : sent) {
      refuse(each, "no", code);
    }
    EXPECT_EQ("robot:54321 refused to take the posture sit: no.", posture.get().problem);
    EXPECT_EQ(CallOutcome::kRefused, unnumbered.get().outcome);
    expectRefusals({{Kind::kPosture, cause, {}, "no", last_order_ - 2},
                    {Kind::kMotion, cause, {}, "no", last_order_ - 1},
                    {Kind::kWalk, cause, {}, "no", last_order_}});
  }
}

TEST_F(Version2SessionTest, AnOrderThatCannotBeSentIsWithdrawn) {
  const auto expect_too_old = [this](const std::string& why, std::uint64_t order) {
    expectRefusals({{RefusedRequest::kMotion, RefusalCause::kTooOld, {}, why, order}});
  };
  auto upload = add(callToStore("NOD.MTN", {1, 2, 3}), milliseconds(10000));
  EXPECT_EQ('U', request()[0]);
  const Frame sent = frame_;
  auto brief = order(callToPlay("SIT.MTN"), milliseconds(100));
  auto old = order(callToPlay("SIT.MTN"), milliseconds(5000));
  pass(milliseconds(100));
  expect_too_old("the request could not be sent within 100 ms", kFirstOrder);
  const Answer brief_answer = brief.get();
  EXPECT_EQ(CallOutcome::kTimeout, brief_answer.outcome);
  EXPECT_FALSE(brief_answer.was_sent);
  pass(milliseconds(401));
  answer(sent, {});
  EXPECT_EQ("", requests());
  expect_too_old("too old: it could not be sent to robot:54321 in time", kFirstOrder + 1);
  EXPECT_EQ("The order to play the motion SIT.MTN is too old: it could not be sent to robot:54321 in time.",
            old.get().problem);
}

TEST_F(Version2SessionTest, AVelocityBelongsToTheWalkThatTheRobotNames) {
  const auto steered = [this](int walk) {
    answer({0, 0, 0, 0, 0, 0, static_cast<std::uint8_t>(walk >> 8), static_cast<std::uint8_t>(walk)});
    return steered_orders_.back();
  };
  const auto send = [this](const WalkVelocity& velocity) {
    steer(velocity);
    EXPECT_EQ("S", requests());
    return static_cast<int>(frame_.header.request_number);
  };
  const auto end = [this](int how, int walk) {
    push('i', version2_frames::makeEnd(version2::ENDED_WALK, how, "walk", "", walk));
    return ended_.back().order;
  };
  send({});
  EXPECT_EQ(std::make_pair(last_order_, std::uint64_t{0}), steered(0));
  const int walk = send({0.1, 0, 0});
  const std::uint64_t began = last_order_;
  EXPECT_EQ(std::make_pair(began, began), steered(walk));
  for (const double forward : {0.1, 0.0}) {  // with 0, it walks to a stand
    send({forward, 0, 0});
    EXPECT_EQ(std::make_pair(last_order_, began), steered(walk));
  }
  EXPECT_EQ(began, end(version2::END_DONE, walk));
  send({0.1, 0, 0});
  EXPECT_EQ(std::make_pair(last_order_, std::uint64_t{0}), steered(walk)) << "that walk has ended";
  const int brief = send({0.1, 0, 0});
  EXPECT_EQ(last_order_, end(version2::END_FELL, brief)) << "it begins a walk that ends at once";
  steered(0);
  expectRefusals({});
}

TEST_F(Version2SessionTest, ACallEndsWithATimeoutIfTheConnectionIsGivenUpAsSilent) {
  auto motion = add(callToPlay("NOD.MTN"));
  EXPECT_EQ("P", requests());
  connection_.calls.failAll("it was silent", FaultKind::kSilent);
  const Answer answer = motion.get();
  EXPECT_EQ(CallOutcome::kTimeout, answer.outcome);
  EXPECT_TRUE(answer.was_sent);
}

TEST_F(Version2SessionTest, OnlyAStopIsSentBeforeZeros) {
  wanted_.streaming = true;
  commandJoints({{11, 0.1}});
  auto motion = order(callToPlay("NOD.MTN"));
  steer({});
  auto held = add(callToHold({2}));
  auto posture = order(callForPosture(Posture::kSit));
  EXPECT_EQ("ISWE", requests());
}

TEST_F(Version2SessionTest, ZerosAreSentAtOnceAndBeforeAVelocityThatCameAfterThem) {
  steer({0.1, 0, 0});
  EXPECT_EQ("S", requests());
  const Frame first = frame_;
  steer({});
  steer({0.2, 0, 0});
  EXPECT_EQ("S 0 0 0 0 52 0 0 0 0 0 0 0 0", request()) << "though the one before is not answered";
  EXPECT_EQ("", request());
  answer(Bytes(8));
  EXPECT_EQ("", request());
  answer(first, Bytes(8));
  EXPECT_EQ("S 0 0 0 0 52 0 200 0 0 0 0 0 0", request());
}

TEST_F(Version2SessionTest, TheNumbersOfOrdersThatGoOnAreNotUsedAgain) {
  steer({0.1, 0, 0});
  auto motion = order(callToPlay("NOD.MTN", 65535));
  commandJoints({{2, 0.1}});
  std::vector<std::uint16_t> going_on;
  for (const char letter : {'P', 'S', 'J'}) {
    EXPECT_EQ(letter, request()[0]);
    going_on.push_back(frame_.header.request_number);
    Bytes reply(letter == 'P' ? 0 : letter == 'J' ? 4 : 8);
    if (letter == 'S') {
      protocol::encodeBigEndian16(frame_.header.request_number, &reply[6]);
    }
    answer(reply);
  }
  for (int i = 0; i < 70000; ++i) {
    commandEars(i % 2 == 0, false);
    EXPECT_EQ('K', request()[0]);
    ASSERT_THAT(going_on, testing::Not(testing::Contains(frame_.header.request_number))) << i;
    answer({0, 0});
  }
  for (const int number : going_on) {
    push('i', version2_frames::makeEnd(version2::ENDED_WALK, version2::END_DONE, "", "", number));
    EXPECT_NE(0u, ended_.back().order);
  }
}

TEST_F(Version2SessionTest, AServerThatEndsNoOrdersIsGivenUp) {
  const auto command = [this] {
    commandJoints({{2, 0.1}});
    EXPECT_EQ("J", requests());
    answer({0, 0, 0, 0});
  };
  for (std::size_t i = 0; i < Version2Session::kMostOpenRequests; ++i) {
    command();
  }
  EXPECT_THAT(whyGivenUp(command), HasSubstr("it has ended none of 1000 orders"));
}

TEST_F(Version2SessionTest, WhatTheRobotRefusesIsToldWithItsOrderAndItsParts) {
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

TEST(Version2Session, SendsAnOrderToStopBeforeEverythingElse) {
  for (const char letter : {'I', 'O'}) {
    NewSession session;
    session.pass(milliseconds(1000));  // a hello would be due
    session.wanted_ = {true, 73, 4};
    session.commandJoints({{2, 0.1}});
    session.limitSpeed({{2, 1.0}});
    session.commandLeds({{1, 255}});
    auto picture = session.takePicture(10);
    auto upload = session.add(callToStore("NOD.MTN", {1, 2, 3}));
    auto samples = session.add(callToPlaySamples({1, 0, 3, false}, {0, 0, 0}));
    auto stop = session.add(letter == 'I' ? callToHold({}) : callForMotors(false));
    EXPECT_EQ(letter == 'I' ? "I 0" : "O 0 0 0 0 0 0", session.request());
    session.answer(letter == 'I' ? Bytes() : Bytes{0});
    EXPECT_EQ(CallOutcome::kDone, stop.get().outcome);
    EXPECT_EQ("HWTFUAVL", session.requests()) << "without J, which came before";
  }
}

TEST(Version2Session, DropsWaitingOrdersAsInThisTable) {
  using Give = std::function<std::future<Answer>(NewSession&)>;
  const auto call = [](const std::function<Call()>& make) {
    return [make](NewSession& session) { return session.add(make()); };
  };
  const auto order = [](const std::function<Call()>& make) {
    return [make](NewSession& session) { return session.order(make()); };
  };
  const auto joint = [](int id) {
    return [id](NewSession& session) {
      session.commandJoints({{id, 0.1}});
      return std::future<Answer>();
    };
  };
  const auto walk = [](double forward) {
    return [forward](NewSession& session) {
      session.steer({forward, 0, 0});
      return std::future<Answer>();
    };
  };
  const auto sit = order([] { return callForPosture(Posture::kSit); });
  const auto play_nod = order([] { return callToPlay("NOD.MTN"); });
  const auto motors_on = [](NewSession& session) {
    Call made = callForMotors(true);
    made.terms = {session.now_ + kLongestOrderWait, 0};
    return session.add(std::move(made));
  };
  const Give waiting[] = {joint(2), joint(11), walk(0.1), play_nod, sit, motors_on, walk(0)};  // 11 is of a leg
  const struct {
    std::string name;
    Give give;
    std::string dropped;  // x: this order of `waiting` is not carried out
  } rows[] = {
      {"hold everything", call([] { return callToHold({}); }), "xxxxxxx"},
      {"hold joint 2", call([] { return callToHold({2}); }), "x--xxx-"},
      {"hold joint 11", call([] {
         return callToHold({3, 11});
       }),
       "-xxxxxx"},
      {"motors off", call([] { return callForMotors(false); }), "xxxxxxx"},
      {"motors on", motors_on, "xx-----"},
      {"posture", sit, "xxx----"},
      {"play SIT", order([] { return callToPlay("SIT.MTN"); }), "xx-----"},
      {"stop NOD", call([] { return callToStop("NOD.MTN"); }), "---x---"},
      {"stop SIT", call([] { return callToStop("SIT.MTN"); }), "-------"},
      {"stop all motions", call([] { return callToStop(""); }), "---x---"},
  };
  for (const auto& row : rows) {
    std::string dropped;
    for (const Give& wait : waiting) {
      NewSession session;
      const std::future<Answer> answer = wait(session);
      const std::future<Answer> other = row.give(session);
      session.requests();
      dropped += !session.refusals_.empty() || (answer.valid() && session.done(answer)) ? "x" : "-";
    }
    EXPECT_EQ(row.dropped, dropped) << row.name;
  }
}

TEST_F(Version2SessionTest, OneRequestForTheMemoryStickIsSentAtATimeAndTheOthersGoOn) {
  auto play = add(callToPlay("NOD.MTN"));
  auto list = add(makeCall(version2::LIST_MOTIONS), milliseconds(200));
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

TEST(Version2Session, LetsAnswersAndPicturesBeLateUntilALargeUploadHasEnded) {
  for (const bool is_refused : {false, true}) {
    NewSession session;
    session.stream();
    auto upload = session.add(callToStore("NOD.MTN", Bytes(65523)), milliseconds(20000));
    EXPECT_EQ('U', session.request(0)[0]);
    const version2_frames::Frame sent = session.frame_;
    session.pass(milliseconds(1000));
    EXPECT_EQ("H 0", session.request());
    const version2_frames::Frame hello = session.frame_;
    session.pass(milliseconds(900));
    is_refused ? session.refuse(sent, "the memory stick is full") : session.answer(sent, {});
    session.answer(hello, version2_frames::makeHello());
    session.live(milliseconds(499));
    EXPECT_EQ(kSilentStream, SessionFixture::whyGivenUp([&] { session.live(milliseconds(1)); }));
  }
}

TEST_F(Version2SessionTest, BehindALargeFileAnswersMayBeLateButNotForEver) {
  auto fetch = add(callToFetchPicture("AIBO0001.JPG"), milliseconds(20000));
  EXPECT_EQ('Y', request()[0]);
  for (int i = 0; i < 4; ++i) {  // the largest file may take 4 s
    request();
    pass(milliseconds(1000));
  }
  request();
  pass(milliseconds(999));
  EXPECT_THAT(whyGivenUpWithin(milliseconds(1)), HasSubstr("did not answer the request 'H' within"));
}

TEST_F(Version2SessionTest, TheRobotTellsOfItsMotorsAndItsPosture) {
  EXPECT_EQ(MotorState::kUnknown, connection_.motors_and_posture.motors);
  const std::pair<std::uint8_t, PostureNow> postures[] = {
      {version2::POSTURE_UNKNOWN, PostureNow::kUnknown}, {version2::POSTURE_STAND, PostureNow::kStanding},
      {version2::POSTURE_SIT, PostureNow::kSitting},     {version2::POSTURE_REST, PostureNow::kLying},
      {version2::POSTURE_WALK, PostureNow::kWalking},    {version2::POSTURE_FALLEN, PostureNow::kFallen},
      {version2::POSTURE_CARRIED, PostureNow::kCarried}, {7, PostureNow::kUnknown},
  };
  for (const auto& [number, posture] : postures) {
    for (const bool on : {true, false}) {
      push('o', {on, number, 0, 0});
      EXPECT_EQ(posture, connection_.motors_and_posture.posture) << +number;
      EXPECT_EQ(on ? MotorState::kOn : MotorState::kOff, connection_.motors_and_posture.motors);
    }
  }
}

TEST_F(Version2SessionTest, EveryKindAndWayOfEndIsToldAndThoseOfANewerServerAreUnknown) {
  const EndedKind kinds[] = {EndedKind::kUnknown, EndedKind::kMotion, EndedKind::kWalk,   EndedKind::kPosture,
                             EndedKind::kJam,     EndedKind::kJoints, EndedKind::kUnknown};
  const EndedHow hows[] = {EndedHow::kDone, EndedHow::kReplaced, EndedHow::kStopped, EndedHow::kRefused,
                           EndedHow::kFell, EndedHow::kUnknown,  EndedHow::kUnknown};
  for (int i = 0; i < 7; ++i) {
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
  EXPECT_EQ(most + "...", connection_.status.robot_message);
  report('e', {0, 3}, most + "x");
  EXPECT_EQ(most + "x", connection_.status.robot_message);
  report('i', {1, 0, 0, 0}, std::string(60000, 'x') + "\n" + std::string(60000, 'y'));
  EXPECT_EQ(std::string(512, 'x') + "...", ended_[0].name);
  EXPECT_EQ(std::string(512, 'y') + "...", ended_[0].reason);
}

TEST_F(Version2SessionTest, ReportsOfAJointAreOverWhenItFollowsAgain) {
  const auto follows = [this](const std::string& joint) {
    push('i', version2_frames::makeEnd(version2::ENDED_JAM, version2::END_DONE, joint, ""));
    return connection_.status.robot_message;
  };
  for (const char* const joint : {"mouth", "tail_tilt", "mouth"}) {
    push('e', version2_frames::makeError(3, joint + std::string(" is jammed")));
  }
  EXPECT_EQ("mouth is jammed", follows("tail")) << "not its name";
  EXPECT_EQ("tail_tilt is jammed", follows("mouth"));
  EXPECT_EQ("", follows("tail_tilt"));
  push('e', version2_frames::makeError(4, "the battery below the mouth is low"));
  EXPECT_EQ("the battery below the mouth is low", follows("mouth")) << "no joint's fault";
  EXPECT_EQ(2, logged("The joint mouth follows its commands again."));
}

}  // namespace
