#include <gmock/gmock.h>

#include <future>
#include <string>
#include <vector>

#include "newest_client_fixture.h"
#include "protocol/motion_requests.h"
#include "protocol/walk_requests.h"

using namespace aibo_client;
using protocol::version2::LEAVE_OUT_MISSING_JOINTS;
using protocol::version2::TELL_CHANGES;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test_pictures::Bytes;
using testing::ElementsAre;
using testing::HasSubstr;
using version2_frames::makeFrame;

namespace {

/// Sensors, LEDs, ears, motions, shutting down and rebooting.
class BodyTest : public NewestClientFixture {
 protected:
  /// Makes a call that waits for the robot.
  template <typename Call>
  static auto inBackground(const Call& call) {
    return std::async(std::launch::async, call);
  }

  /// Answers the client's next request, which has to be this one, and returns its payload.
  static Bytes answer(ScriptedPeer* peer, char kind, const Bytes& payload = {}) {
    const version2_frames::Frame frame = peer->readRequest();
    EXPECT_EQ(kind, frame.header.kind);
    peer->send(makeFrame(protocol::version2::replyKind(kind), frame.header.request_number, payload));
    return frame.payload;
  }
};

TEST_F(BodyTest, LedsAndEarsAreCommandedWithoutWaiting) {
  ScriptedPeer peer = connectVersion2();
  client().commandLeds({{7, 200, LedMode::kB}});
  EXPECT_THAT(peer.readRequest().payload, ElementsAre(7, 200, 1, 0));
  client().commandEars(false, true);
  EXPECT_THAT(peer.readRequest().payload, ElementsAre(0, 1));
}

TEST_F(BodyTest, MotionsAreStoredListedPlayedStoppedAndDeletedInAnyCase) {
  ScriptedPeer peer = connectVersion2();
  auto calls = inBackground([this] {
    client().uploadMotion("nod.mtn", {1, 2, 3}, seconds(20));
    const std::vector<std::string> names = client().listMotions(seconds(20));
    client().playMotion("Nod.mtn", 2, seconds(20));
    client().stopMotion("nod.MTN", seconds(20));
    client().stopMotion("", seconds(20));
    client().deleteMotion("nod.mtn", seconds(20));
    return names;
  });
  const std::string name = "NOD.MTN";
  EXPECT_EQ(Bytes({7, 'N', 'O', 'D', '.', 'M', 'T', 'N', 1, 2, 3}), answer(&peer, 'U'));
  answer(&peer, 'N', Bytes(name.begin(), name.end()));
  for (const std::uint8_t repetitions : Bytes{2, 0}) {
    EXPECT_EQ(Bytes({0, repetitions, 'N', 'O', 'D', '.', 'M', 'T', 'N'}), answer(&peer, 'P'));
  }
  EXPECT_EQ(Bytes({0, 0}), answer(&peer, 'P'));
  EXPECT_EQ(Bytes(name.begin(), name.end()), answer(&peer, 'D'));
  EXPECT_THAT(calls.get(), ElementsAre(name));
}

TEST_F(BodyTest, TheRobotSaysWhatItPlaysDifferently) {
  ScriptedPeer peer = connectVersion2();
  const std::string changes = "2 positions are clipped";
  for (const std::string& text : {changes, std::string()}) {
    auto call = inBackground([this] { return client().playMotion("NOD.MTN", 2, seconds(20)); });
    const version2_frames::Frame request = peer.readRequest();
    EXPECT_EQ(TELL_CHANGES, request.header.id);
    peer.send(makeFrame('p', request.header.request_number, Bytes(text.begin(), text.end())));
    EXPECT_EQ(text, call.get());
  }
  auto stop = inBackground([this] { client().stopMotion("NOD.MTN", seconds(20)); });
  const version2_frames::Frame request = peer.readRequest();
  EXPECT_EQ(0, request.header.id);
  peer.send(makeFrame('p', request.header.request_number, {}));
  stop.get();
}

TEST_F(BodyTest, ARobotThatTellsNonsenseAboutAMotionIsDisconnected) {
  ScriptedPeer peer = connectVersion2();
  auto call = inBackground([this] { client().playMotion("NOD.MTN", 2, seconds(20)); });
  peer.send(makeFrame('p', peer.readRequest().header.request_number, {0x1b, '[', 'J'}));
  EXPECT_THROW(call.get(), NetworkException);
}

TEST_F(BodyTest, JointsThatTheRobotDoesNotHaveAreLeftOutIfItIsAnOption) {
  ClientOptions options = optionsFor(server_);
  options.leave_out_missing_joints = true;
  RcServerClient client(options, recorder_.callbacks());
  client.start();
  ScriptedPeer peer = server_.accept();
  peer.agreeToVersion2("U P");
  ASSERT_TRUE(recorder_.waitForState(ConnectionState::kConnected));
  auto calls = inBackground([&client] {
    client.uploadMotion("NOD.MTN", {1}, seconds(20));
    client.playMotion("NOD.MTN", 1, seconds(20));
  });
  version2_frames::Frame request = peer.readRequest();
  EXPECT_EQ(LEAVE_OUT_MISSING_JOINTS, request.header.id);
  peer.send(makeFrame('u', request.header.request_number, {}));
  request = peer.readRequest();
  EXPECT_EQ(LEAVE_OUT_MISSING_JOINTS | TELL_CHANGES, request.header.id);
  peer.send(makeFrame('p', request.header.request_number, {}));
  calls.get();
}

TEST_F(BodyTest, WalksAreGuardedUnlessTheUserSaysOtherwise) {
  for (const bool is_guarded : {true, false}) {
    ClientOptions options = optionsFor(server_);
    EXPECT_TRUE(options.guard_walks);
    options.guard_walks = is_guarded;
    RcServerClient client(options, recorder_.callbacks());
    client.start();
    ScriptedPeer peer = server_.accept();
    peer.agreeToVersion2("S");
    ASSERT_TRUE(recorder_.waitForState(ConnectionState::kConnected));
    client.steer({0.1, 0, 0});
    const version2_frames::Frame request = peer.readRequest();
    EXPECT_EQ(is_guarded ? protocol::version2::STEER_GUARDED : 0, request.header.id);
    peer.send(makeFrame('s', request.header.request_number, {0, 100, 0, 0, 0, 0, 0, 0}));
    client.guardWalks(!is_guarded);
    client.steer({0.1, 0, 0});
    EXPECT_EQ(is_guarded ? 0 : protocol::version2::STEER_GUARDED, peer.readRequest().header.id) << "from then on";
  }
}

TEST_F(BodyTest, TheRobotIsShutDownAndTheClientWaitsForItsReturn) {
  {
    ScriptedPeer peer = connectVersion2();
    auto call = inBackground([this] { client().shutDownRobot(seconds(20)); });
    EXPECT_EQ(Bytes(), answer(&peer, 'Q'));
    call.get();
  }
  ScriptedPeer peer = connectVersion2();
  auto call = inBackground([this] { client().rebootRobot(seconds(20)); });
  EXPECT_EQ(Bytes(), answer(&peer, 'R'));
  call.get();
}

TEST_F(BodyTest, ARefusalIsThrownWithTheRobotsReason) {
  ScriptedPeer peer = connectVersion2();
  auto complaint = inBackground(
      [this] { return complaintOf<CommandException>([this] { client().playMotion("GONE.MTN", 1, seconds(20)); }); });
  const int number = peer.readRequest().header.request_number;
  peer.send(makeFrame('e', number, version2_frames::makeError(1, "there is no GONE.MTN")));
  EXPECT_THAT(complaint.get(), HasSubstr("refused to play the motion GONE.MTN: there is no GONE.MTN."));
}

TEST_F(BodyTest, NothingIsRepeatedAfterAReconnectAndWaitingCallersGetAnError) {
  ScriptedPeer peer = connectVersion2("U L K J S");
  auto upload = inBackground([this] { client().uploadMotion("NOD.MTN", {1}, seconds(60)); });
  EXPECT_EQ('U', peer.readRequest().header.kind);
  for (int i = 1; i < 10; ++i) {
    client().commandLeds({{i, 100}});  // one is sent, the others wait for its answer
    client().commandEars(true, true);
    client().commandJoints({{i, 0.1}}, milliseconds(0));  // four are sent
    client().steer({0.01 * i, 0, 0});
  }
  peer.close();
  EXPECT_THROW(upload.get(), NetworkException);
  ScriptedPeer next = connectVersion2("U L K J S");
  ASSERT_TRUE(eventually([&] { return client().status().state == ConnectionState::kConnected; }));
  client().commandLeds({{200, 1}});
  EXPECT_THAT(next.readRequest().payload, ElementsAre(200, 1, 0, 0)) << "the first that is sent";
}

TEST_F(BodyTest, WithoutAConnectionNothingIsKept) {
  EXPECT_THROW(client().commandLeds({{1, 1}}), NetworkException);
  EXPECT_THROW(client().commandEars(true, true), NetworkException);
  EXPECT_THROW(client().playMotion("NOD.MTN", 1, seconds(20)), NetworkException);
}

TEST_F(BodyTest, AServerWithoutLedsAndEarsGetsNoCommandsToThem) {
  ScriptedPeer peer = connectVersion2("F W");
  EXPECT_THAT(complaintOf<CommandException>([this] { client().commandLeds({{1, 1}}); }), HasSubstr("it has no LEDs"));
  EXPECT_THAT(complaintOf<CommandException>([this] { client().commandEars(true, true); }), HasSubstr("it has no ears"));
}

TEST_F(BodyTest, ArgumentsAreCheckedBeforeAnythingIsSent) {
  EXPECT_THROW(client().commandLeds({{1, 256}}), InvalidArgumentException);
  EXPECT_THROW(client().playMotion("../NOD.MTN", 1, seconds(1)), InvalidArgumentException);
  EXPECT_THROW(client().playMotion("", 1, seconds(1)), InvalidArgumentException);
  EXPECT_THROW(client().playMotion("NOD.MTN", 0, seconds(1)), InvalidArgumentException);
  EXPECT_THROW(client().playMotion("NOD.MTN", 65536, seconds(1)), InvalidArgumentException);
  EXPECT_THROW(client().stopMotion("NOD", seconds(1)), InvalidArgumentException);
  EXPECT_THROW(client().uploadMotion("NOD.MTN", {}, seconds(1)), InvalidArgumentException);
  EXPECT_THROW(client().deleteMotion("", seconds(1)), InvalidArgumentException);
  EXPECT_THROW(client().listMotions(milliseconds(0)), InvalidArgumentException);
}

}  // namespace
