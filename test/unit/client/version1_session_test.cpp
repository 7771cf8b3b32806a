#include "client/version1_session.h"

#include "session_fixture.h"

using namespace aibo_client;
using namespace test_support;
using std::chrono::milliseconds;
using test_pictures::Bytes;

namespace version2 = protocol::version2;

namespace {

class Version1SessionTest : public SessionFixture {
 public:
  Session& session() override { return session_; }

  Bytes bytes() { return session().nextRequest(wanted_, now_); }

  /// What the session sends now: "" or letter and identifier, as in "W73", and the value that is set, as in "J2=-100".
  std::string command() {
    const Bytes bytes = this->bytes();
    if (bytes.empty()) {
      return "";
    }
    const std::string command = static_cast<char>(bytes[0]) + std::to_string(bytes[1]);
    return bytes.size() == 2 ? command : command + "=" + std::to_string(protocol::decodeValueReply(bytes.data()).value);
  }

  /// The letter of what the session sends now; a blank if nothing.
  char request() { return (command() + " ")[0]; }

  /// Receives the answer to a request that reads or sets a value.
  void receiveValue(const std::string& request, int value = 0) {
    const auto bits = static_cast<unsigned>(value);
    receive({static_cast<std::uint8_t>(request[0] - 'A' + 'a'), static_cast<std::uint8_t>(std::stoi(request.substr(1))),
             static_cast<std::uint8_t>(bits & 0xFF), static_cast<std::uint8_t>(bits >> 8 & 0xFF)});
  }

  void receivePicture(unsigned number) { receive(test_pictures::makeReply(test_pictures::makeNumbered(number))); }

  Version1Session session_{connection_, VersionAnswer::kVersion1, now_};
};

/// For the rows of tables.
struct NewVersion1Session : public Version1SessionTest {
  void TestBody() override {}
};

// `W` is a toggle: one too many would switch the stream off.
TEST_F(Version1SessionTest, TheStreamIsToggledOnceForEachChangeOfTheSetting) {
  int toggles = 0;
  for (int i = 0; i < 1000; ++i) {
    wanted_.streaming = i % 3 != 0;
    toggles += command().empty() ? 0 : 1;
    EXPECT_EQ(wanted_.streaming, toggles % 2 == 1);
    EXPECT_EQ(wanted_.streaming, connection_.pictures.streaming());
  }
}

TEST_F(Version1SessionTest, WithoutAStreamEachCallerGetsAPictureOfItsOwnQuality) {
  auto first = takePicture(40);
  auto second = takePicture(0);
  EXPECT_EQ("F40", command());
  EXPECT_EQ("", command()) << "one after the other";
  receivePicture(1);
  const Answer got = first.get();
  EXPECT_EQ(test_pictures::makeNumbered(1), got.picture->jpeg);
  EXPECT_EQ(40, got.picture->quality);
  EXPECT_FALSE(done(second));
  EXPECT_EQ("F73", command()) << "0 is the stream's quality";
  receivePicture(2);
  EXPECT_EQ(test_pictures::makeNumbered(2), second.get().picture->jpeg);
  EXPECT_EQ(2u, pictures_.size()) << "they are published like any other";
}

TEST_F(Version1SessionTest, DuringTheStreamACallerGetsTheNextPictureThatBegins) {
  wanted_.streaming = true;
  command();
  wanted_.jpeg_quality = 60;  // of the next stream
  const Bytes reply = test_pictures::makeReply(test_pictures::makeNumbered(1));
  receive(Bytes(reply.begin(), reply.begin() + 100));
  pass(milliseconds(1));
  auto first = takePicture(10);
  auto second = takePicture(20);
  pass(milliseconds(1));
  receive(Bytes(reply.begin() + 100, reply.end()));
  EXPECT_FALSE(done(first)) << "this one had begun before the call";
  EXPECT_EQ("", command()) << "no F while the stream runs";
  pass(milliseconds(32));
  receivePicture(2);
  ASSERT_TRUE(done(first));
  ASSERT_TRUE(done(second));
  const Answer got = first.get();
  EXPECT_EQ(73, got.picture->quality);
  EXPECT_EQ(test_pictures::makeNumbered(2), got.picture->jpeg);
  EXPECT_EQ(got.picture, second.get().picture);
}

TEST_F(Version1SessionTest, AfterAStopTheRequestWaitsUntilTheStreamHasDrained) {
  wanted_.streaming = true;
  command();
  receivePicture(1);
  wanted_.streaming = false;
  command();
  auto answer = takePicture(30);
  EXPECT_EQ("", command());
  pass(milliseconds(950));
  receivePicture(2);
  EXPECT_FALSE(done(answer)) << "a late picture of the stream is not fresh";
  pass(milliseconds(49));
  EXPECT_EQ("", command());
  EXPECT_EQ(now_ + milliseconds(1), session_.nextDeadline());
  pass(milliseconds(1));
  EXPECT_EQ("F30", command());
  receivePicture(3);
  EXPECT_EQ(test_pictures::makeNumbered(3), answer.get().picture->jpeg);
}

TEST_F(Version1SessionTest, ADamagedPictureIsDroppedAndRequestedAgainIfItIsACallers) {
  auto answer = takePicture(30);
  command();
  receive(test_pictures::makeReply(Bytes(5000, 0)));
  EXPECT_EQ("F30", command());
  receivePicture(2);
  EXPECT_EQ(test_pictures::makeNumbered(2), answer.get().picture->jpeg);
  wanted_.streaming = true;
  command();
  receive(test_pictures::makeReply(Bytes(5000, 0)));
  receivePicture(3);
  EXPECT_EQ(2u, pictures_.size());
  EXPECT_EQ(2u, counters_.corrupt_pictures);
  EXPECT_EQ(1, logged("sent a damaged picture"));
}

TEST_F(Version1SessionTest, AJointIsSentInHundredthsOfADegreeAndReportedInRadian) {
  commandJoints({{2, -0.5}});
  EXPECT_EQ("J2=-2865", command());
  receive({'j', 2, 0xCF, 0xF4});  // -2865
  EXPECT_THAT(accepted_, testing::ElementsAre("2=-0.500037 "));
  EXPECT_TRUE(telemetry_.empty());
}

TEST_F(Version1SessionTest, SpeedLimitsAndThenJointsAreSentAloneAndOneAtATime) {
  commandJoints({{1, 0.1}, {2, 0.2}});
  limitSpeed({{1, 0.5}, {2, 20}});
  EXPECT_EQ("V1=2865", command());
  wanted_.streaming = true;
  auto answer = takePicture(10);
  EXPECT_EQ("", command()) << "TCP may join two requests, and the robot would take them for another one";
  receiveValue("V1", 2865);
  EXPECT_EQ("W73", command());
  EXPECT_EQ("V2=32767", command()) << "the fastest that version 1 can express";
  receiveValue("V2", 32767);
  EXPECT_EQ("J1=573", command());
  EXPECT_EQ("", command());
  receiveValue("J1", 573);
  EXPECT_EQ("J2=1146", command());
}

// The ERS-7's table; 20 of each a second.
TEST_F(Version1SessionTest, WithTelemetryWantedJointsAndSensorsAreAskedForInTurn) {
  wanted_.telemetry_period = 4;
  std::string asked;
  for (int i = 0; i < 40; ++i) {
    const std::string request = command();
    asked += request + " ";
    EXPECT_EQ("", command()) << "one at a time";
    receiveValue(request, request[0] == 'J' ? -1000 : 1);
    EXPECT_EQ("", command()) << "the next one is not due yet";
    pass(milliseconds(25));
  }
  EXPECT_EQ(
      "J1 S5 J2 S6 J3 S7 J4 S8 J11 S9 J12 S14 J13 S24 J21 S34 J22 S44 J23 S53 J31 S54 J32 S55 J33 S61 J41 S62 J42 S63 "
      "J43 S66 J51 S67 J52 S94 J1 S5 J2 S6 ",
      asked);
  ASSERT_EQ(40u, telemetry_.size());
  wanted_.telemetry_period = 0;
  EXPECT_EQ("", command());
  pass(milliseconds(5000));
  EXPECT_EQ("", command());
}

TEST_F(Version1SessionTest, EachValueIsReportedInItsUnitWithTheTimeOfItsFirstByte) {
  const std::pair<std::string, std::pair<int, double>> rows[] = {
      {"J11", {-1000, -0.1745329}},  // hundredths of a degree
      {"S24", {1, 1}},               // a switch
  };
  wanted_.telemetry_period = 4;
  for (const auto& [name, values] : rows) {
    std::string request = command();
    for (; request != name; request = command()) {
      receiveValue(request);
      pass(milliseconds(25));
    }
    const TimePoint first_byte_time = now_;
    receive({static_cast<std::uint8_t>(name[0] - 'A' + 'a')});
    pass(milliseconds(10));
    receive({static_cast<std::uint8_t>(std::stoi(name.substr(1))), static_cast<std::uint8_t>(values.first & 0xFF),
             static_cast<std::uint8_t>(values.first >> 8 & 0xFF)});
    const Telemetry& telemetry = telemetry_.back();
    EXPECT_EQ(first_byte_time, telemetry.arrival);
    EXPECT_FALSE(telemetry.frame_number);
    EXPECT_NEAR(values.second, name[0] == 'J' ? telemetry.joints.at(0).position : telemetry.sensors.at(0).value, 1e-6)
        << name;
    pass(milliseconds(15));
  }
}

TEST_F(Version1SessionTest, LedsAreSetOneByOne) {
  commandLeds({{7, 255, LedMode::kB}, {8, 0}});
  EXPECT_EQ("L7=255", command());
  EXPECT_EQ("", command());
  commandLeds({{8, 10}});
  receiveValue("L7", 255);
  EXPECT_EQ("7=255A ", leds_);
  EXPECT_EQ("L8=10", command()) << "the latest";
}

TEST_F(Version1SessionTest, WhileAMotionIsUploadedPicturesGoOnAndEverythingElseWaits) {
  wanted_ = {true, 73, 4};
  EXPECT_EQ("W73", command());
  auto upload = add(callToStore("NOD.MTN", Bytes(1234, 7)), milliseconds(20000));
  auto play = add(callToPlay("NOD.MTN"), milliseconds(20000));
  commandJoints({{1, 0.1}});
  const Bytes sent = bytes();
  ASSERT_EQ(18u + 1234u, sent.size());
  EXPECT_EQ(Bytes({2, 0, 210, 0}), Bytes(sent.begin() + 14, sent.begin() + 18)) << "2 * 512 + 210";
  EXPECT_EQ(Bytes(1234, 7), Bytes(sent.begin() + 18, sent.end()));
  for (int i = 0; i < 100; ++i) {
    pass(milliseconds(33));
    receivePicture(1);
    EXPECT_EQ("", command());
  }
  EXPECT_EQ(100u, pictures_.size());
  receive({'u', 0, 0, 0});
  EXPECT_EQ(CallOutcome::kDone, upload.get().outcome);
  EXPECT_EQ("P0", command().substr(0, 2));
  EXPECT_FALSE(done(play));
}

TEST_F(Version1SessionTest, ASlowUploadDoesNotMakeTheStreamSeemDead) {
  wanted_.streaming = true;
  command();
  auto upload = add(callToStore("NOD.MTN", Bytes(65523)), milliseconds(20000));
  EXPECT_FALSE(bytes().empty());
  pass(milliseconds(1900));
  receive({'u', 0, 0, 0});
  EXPECT_EQ(kSilentStream, whyGivenUpWithin(milliseconds(500))) << "it has been answered, so pictures are due again";
}

TEST_F(Version1SessionTest, ErrorCodesAreExplained) {
  const struct {
    Call call;
    std::uint8_t code;
    std::string problem;
  } rows[] = {
      {callForPicture(30), 1, "refused to take a picture: error code 1."},
      {callToPlay("NOD.MTN"), 1, "there is no such file in OPEN-R/MW/DATA/P on its memory stick"},
      {callToPlay("NOD.MTN"), 0, "are its motors on, and is the file a motion for this robot?"},
      {callToDelete("NOD.MTN"), 2, "does not accept this as the name of a motion"},
      {callToStore("NOD.MTN", Bytes(10)), 0, "needs a line ALLOW_UPLOAD=yes"},
      {callToDelete("NOD.MTN"), 0, "ALLOW_DELETE=yes"},
      {makeCall(version2::SHUT_DOWN), 0, "refused to shut down: is it allowed?"},
      {makeCall(version2::REBOOT), 0, "ALLOW_REBOOT=yes"},
  };
  for (const auto& row : rows) {
    auto answer = add(row.call);
    EXPECT_FALSE(bytes().empty());
    receive({'e', 0, row.code, 0});
    const Answer refusal = answer.get();
    EXPECT_EQ(CallOutcome::kRefused, refusal.outcome);
    EXPECT_THAT(refusal.problem, testing::HasSubstr(row.problem));
  }
}

// The next answer could belong to any request.
TEST(Version1Session, EndsTheConnectionIfARequestHasNoAnswer) {
  const struct {
    std::function<std::future<Answer>(NewVersion1Session&)> ask;
    int time;
    std::string request;
    std::string problem;  // of the call
  } rows[] = {
      {[](auto& robot) { return robot.takePicture(30, milliseconds(300)); }, 300, "to take a picture", "within 300 ms"},
      {[](auto& robot) { return robot.add(callToPlay("NOD.MTN"), milliseconds(3000)); }, 3000,
       "to play the motion NOD.MTN", "no answer within 3000 ms. The robot may or may not play the motion NOD.MTN."},
      {[](auto& robot) {
         robot.commandJoints({{1, 0.1}});
         return std::future<Answer>();
       },
       1000, "'J' for joint 1", ""},
  };
  for (const auto& row : rows) {
    NewVersion1Session robot;
    std::future<Answer> answer = row.ask(robot);
    EXPECT_FALSE(robot.bytes().empty());
    robot.pass(milliseconds(row.time - 1));
    EXPECT_EQ("robot:54321 did not answer the request " + row.request + " within " + std::to_string(row.time) + " ms",
              robot.whyGivenUpWithin(milliseconds(1)));
    EXPECT_THAT(answer.valid() ? answer.get().problem : "", testing::HasSubstr(row.problem));
  }
}

/// A server that has not said anything yet.
class SilentServerTest : public Version1SessionTest {
 protected:
  Session& session() override { return silent_; }

  Version1Session silent_{connection_, VersionAnswer::kNotAsked, now_};
};

// Connections to a stopped process succeed, too.
TEST_F(SilentServerTest, IsAskedForAPictureAndNotConnectedUntilItAnswers) {
  wanted_.telemetry_period = 4;
  now_ += milliseconds(450);  // it was asked for version 2 first
  EXPECT_EQ("F73", command());
  EXPECT_EQ("", command());
  pass(milliseconds(499));
  EXPECT_FALSE(silent_.ready());
  EXPECT_EQ(kSilentStream, whyGivenUpWithin(milliseconds(1)));
}

TEST_F(SilentServerTest, IsConnectedWhenThePictureComesWhichIsNobodys) {
  EXPECT_EQ("F73", command());
  receivePicture(1);
  EXPECT_TRUE(silent_.ready());
  EXPECT_TRUE(pictures_.empty());
  auto answer = takePicture(30);
  EXPECT_EQ("F30", command());
  receivePicture(2);
  EXPECT_EQ(test_pictures::makeNumbered(2), answer.get().picture->jpeg);
}

TEST_F(SilentServerTest, IsConnectedWhenTheStreamThatIsWantedComes) {
  wanted_.streaming = true;
  wanted_.telemetry_period = 4;
  EXPECT_EQ("W73", command());
  EXPECT_EQ("", command());
  EXPECT_GT(silent_.nextDeadline(), now_) << "nothing is due before";
  EXPECT_FALSE(silent_.ready());
  receivePicture(1);
  EXPECT_TRUE(silent_.ready());
  EXPECT_EQ(1u, pictures_.size());
}

TEST_F(Version1SessionTest, AServerThatAgreesToVersion2TooLateIsGivenUp) {
  Version1Session session(connection_, VersionAnswer::kNone, now_);
  const Bytes late = {'x', 2, 0, 0};
  EXPECT_EQ("robot:54321 did not answer the request for version 2 of the protocol within 500 ms",
            whyGivenUp([&] { session.bytesArrived(late.data(), late.size(), now_); }));
}

TEST_F(Version1SessionTest, TheOrderAndTheJointAreNamed) {
  commandJoints({{2, 0.5}});
  limitSpeed({{3, 0.5}});
  commandLeds({{7, 1}});
  commandEars(false, true);
  std::uint8_t code = 4;
  for (const char letter : {'V', 'J', 'K', 'K', 'L'}) {
    EXPECT_EQ(letter, request());
    receive({'e', 0, code++, 0});
  }
  expectRefusals({{RefusedRequest::kSpeedLimits, RefusalCause::kRobot, {3}, "error code 4", 0},
                  {RefusedRequest::kJoints,
                   RefusalCause::kRobot,
                   {2},
                   "error code 5; are its motors on, and can the joint move freely?",
                   0},
                  {RefusedRequest::kEars, RefusalCause::kRobot, {1}, "error code 6", 0},
                  {RefusedRequest::kEars, RefusalCause::kRobot, {2}, "error code 7", 0},
                  {RefusedRequest::kLeds, RefusalCause::kRobot, {7}, "error code 8", 0}});
  EXPECT_TRUE(log_.empty());
}

TEST_F(Version1SessionTest, AnOrderEndsOnceAndNothingSaysHow) {
  using Kind = RefusedRequest;
  const std::string why = "error code 0; are its motors on, and can the joint move freely?";
  const std::string late = "too old: it could not be sent to robot:54321 in time";
  const auto refusal = [&](int joint) { return Refusal{Kind::kJoints, RefusalCause::kRobot, {joint}, why, 0}; };
  const struct {
    std::string answers;  // to joints 1 and 2: + accepted, - refused, s: stopped before it is sent, o: too old, l: late
    std::vector<EndedHow> ends;
    std::vector<Refusal> refusals;
  } rows[] = {
      {"++", {EndedHow::kUnknown}, {}},
      {"ll", {EndedHow::kUnknown}, {}},
      {"+-", {EndedHow::kRefused}, {refusal(2)}},
      {"-+", {EndedHow::kRefused}, {refusal(1)}},
      {"--", {EndedHow::kRefused}, {refusal(1), refusal(2)}},
      {"+s", {EndedHow::kUnknown}, {{Kind::kJoints, RefusalCause::kStopped, {2}, "a stop", 0}}},
      {"+o", {EndedHow::kUnknown}, {{Kind::kJoints, RefusalCause::kTooOld, {2}, late, 0}}},
      {"ss", {}, {{Kind::kJoints, RefusalCause::kStopped, {1, 2}, "a stop", kFirstOrder}}},
      {"oo", {}, {{Kind::kJoints, RefusalCause::kTooOld, {1, 2}, late, kFirstOrder}}},
  };
  for (const auto& row : rows) {
    NewVersion1Session robot;
    robot.commandJoints({{1, 0.1}, {2, 0.2}});
    for (std::uint8_t joint = 1; joint <= 2; ++joint) {
      const char answer = row.answers[joint - 1U];
      if (answer == 's') {
        robot.connection_.commands.stopJoints({}, "a stop");
      } else if (answer == 'o') {
        robot.now_ += milliseconds(501);
      } else if (answer == 'l') {  // the second one is later than an order may be, but not than a further joint
        robot.now_ += milliseconds(400);
      }
      const bool is_sent = answer == '+' || answer == '-' || answer == 'l';
      EXPECT_EQ(is_sent ? 'J' : ' ', robot.request()) << row.answers;
      EXPECT_TRUE(robot.ended_.empty() || !is_sent) << row.answers;
      if (is_sent) {
        robot.receive(answer == '-' ? Bytes{'e', 0, 0, 0} : Bytes{'j', joint, 0, 0});
      }
    }
    EXPECT_EQ(' ', robot.request());
    std::vector<EndedHow> ends;
    for (const ActivityEnd& end : robot.ended_) {
      EXPECT_EQ(kFirstOrder, end.order);
      EXPECT_EQ(EndedKind::kJoints, end.kind);
      ends.push_back(end.how);
    }
    EXPECT_EQ(row.ends, ends) << row.answers;
    robot.expectRefusals(row.refusals);
  }
}

TEST_F(Version1SessionTest, AMotionEndsWhenItHasBegun) {
  auto motion = order(callToPlay("NOD.MTN"));
  EXPECT_EQ('P', request());
  receive({'p', 0, 0, 0});
  ASSERT_EQ(1u, ended_.size());
  EXPECT_EQ(EndedKind::kMotion, ended_[0].kind);
  EXPECT_EQ(EndedHow::kUnknown, ended_[0].how);
  EXPECT_EQ("NOD.MTN", ended_[0].name);
  EXPECT_EQ(kFirstOrder, ended_[0].order);
  auto refused = order(callToPlay("SIT.MTN"));
  EXPECT_EQ('P', request());
  receive({'e', 0, 1, 0});
  EXPECT_EQ(kFirstOrder + 1, refusals_.at(0).order);
  EXPECT_EQ(1u, ended_.size());
}

TEST_F(Version1SessionTest, ASettingChangesNoByteAndTheLogSaysThatItHasNoEffect) {
  wanted_.streaming = true;
  EXPECT_EQ("W73", command());
  EXPECT_TRUE(log_.empty());
  wanted_.format = {Resolution::kDouble, 4};
  wanted_.camera.gain = 3;
  wanted_.colors.on = true;
  wanted_.microphone.on = true;
  wanted_.transport = PictureTransport::kUdp;
  wanted_.datagram_port = 5000;
  EXPECT_EQ("", command());
  EXPECT_EQ("", command());
  EXPECT_EQ(1, logged("speaks version 1 of the protocol: it sends every image at 208x160 by TCP"));
}

TEST(VersionAnswerTest, IsTheFirstFourBytesAndTheRestIsForTheSession) {
  const struct {
    Bytes bytes;
    VersionAnswer answer;
    Bytes rest;
  } rows[] = {
      {{'x', 2}, VersionAnswer::kNone, {'x', 2}},
      {{'x', 2, 0, 0, 'h', 0}, VersionAnswer::kVersion2, {'h', 0}},
      {{'x', 1, 0, 0}, VersionAnswer::kVersion1, {}},
      {{'e', 0, 0, 0}, VersionAnswer::kVersion1, {}},
      {{'H', 'T', 'T', 'P'}, VersionAnswer::kNone, {'H', 'T', 'T', 'P'}},
  };
  for (auto [bytes, answer, rest] : rows) {
    EXPECT_EQ(answer, takeVersionAnswer(&bytes)) << testing::PrintToString(rest);
    EXPECT_EQ(rest, bytes);
  }
}

}  // namespace
