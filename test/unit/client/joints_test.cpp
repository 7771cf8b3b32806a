#include <gmock/gmock.h>

#include <atomic>
#include <future>
#include <mutex>

#include "newest_client_fixture.h"

using namespace aibo_client;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::HasSubstr;
using version2_frames::makeFrame;

namespace {

class JointsTest : public NewestClientFixture {};

TEST_F(JointsTest, NothingIsSaidOfARobotThatIsNotConnected) {
  ScriptedPeer peer = connectVersion2();
  EXPECT_EQ(2, client().status().protocol_version);
  EXPECT_EQ(2u, client().status().robot.joint_limits.size());
  EXPECT_FALSE(client().status().robot.hasCapability("X")) << "that was the robot before";
  EXPECT_EQ("ERS-7", client().status().robot.design);
  peer.send(makeFrame('o', 0, {1, protocol::version2::POSTURE_SIT, 0, 0}));
  EXPECT_TRUE(eventually([&] { return client().motorsAndPosture().motors == MotorState::kOn; }));
  peer.close();
  ASSERT_TRUE(recorder_.waitForState(ConnectionState::kDisconnected));
  EXPECT_TRUE(client().motorsAndPosture() == MotorsAndPosture());
  const ConnectionStatus status = client().status();
  EXPECT_EQ(0, status.protocol_version);
  EXPECT_EQ("", status.robot.design);
  EXPECT_FALSE(status.robot.hasCapability("F"));
}

TEST_F(JointsTest, AServerThatRefusesVersion2IsSpokenToInVersion1) {
  client().setStreaming(true);
  ScriptedPeer peer = connectVersion1();
  EXPECT_EQ(1, client().status().protocol_version);
  EXPECT_EQ("", client().status().robot.design);
  expectCommand(&peer, 'W', 73);
  peer.sendPicture(test_pictures::makeNumbered(1));
  ASSERT_TRUE(recorder_.waitForPictures(1));
  EXPECT_FALSE(recorder_.pictures()[0]->frame_number);
}

TEST_F(JointsTest, ALateAgreementIsFollowedByANewConnection) {
  client().start();
  ScriptedPeer peer = server_.accept();
  expectCommand(&peer, 'X', 2);
  expectCommand(&peer, 'F', 73);
  peer.send({'x', 2, 0, 0});
  peer.waitUntilClosed();
  ScriptedPeer next = server_.accept();
  next.agreeToVersion2();
  EXPECT_TRUE(eventually([&] { return client().status().protocol_version == 2; }));
}

// Each of these connections ends when the client has waited for a second.
TEST_F(JointsTest, WhatAVersion1ServerDoesNotAnswerOverThreeConnectionsIsNotAskedForOverTheFourth) {
  ClientOptions options = optionsFor(server_);
  options.read_timeout = milliseconds(1000);
  RcServerClient client(options, recorder_.callbacks());
  client.setTelemetryPeriod(4);
  client.start();
  for (int connection = 1; connection <= 4; ++connection) {
    ScriptedPeer peer = accept();
    expectCommand(&peer, 'J', 1);
    peer.send({'j', 1, 0, 0});
    EXPECT_EQ(connection < 4 ? 'S' : 'J', peer.readCommand().command) << connection;
    if (connection < 4) {
      peer.waitUntilClosed();
    }
  }
}

TEST_F(JointsTest, WithVersion1AsAnOptionTheServerIsNotAskedForItsVersion) {
  ClientOptions options = optionsFor(server_);
  options.protocol_version = 1;
  RcServerClient client(options, recorder_.callbacks());
  client.start();
  ScriptedPeer peer = server_.accept();
  expectCommand(&peer, 'F', 73);
  EXPECT_EQ(ConnectionState::kConnecting, client.status().state) << "it has not answered";
  peer.sendPicture(test_pictures::make());
  ASSERT_TRUE(recorder_.waitForState(ConnectionState::kConnected));
  EXPECT_FALSE(peer.readCommandWithin(milliseconds(50)));
  EXPECT_TRUE(recorder_.pictures().empty()) << "nobody has asked for it";
}

TEST_F(JointsTest, StreamAndTelemetryAreWantedAgainAfterAReconnect) {
  client().setStreaming(true);
  client().setTelemetryPeriod(4);
  for (int i = 0; i < 2; ++i) {
    ScriptedPeer peer = connectVersion2();
    EXPECT_EQ('W', peer.readRequest().header.kind);
    const version2_frames::Frame telemetry = peer.readRequest();
    EXPECT_EQ('T', telemetry.header.kind);
    EXPECT_THAT(telemetry.payload, ElementsAre(0, 4));
  }
}

TEST_F(JointsTest, TelemetryIsDelivered) {
  ScriptedPeer peer = connectVersion2();
  peer.send(makeFrame('t', 0, version2_frames::makeTelemetry(7, {{'J', 1, 0}})));
  ASSERT_TRUE(recorder_.waitForTelemetry(1));
  EXPECT_EQ(2u, recorder_.telemetry()[0].connection_number);
  EXPECT_EQ(1u, client().statistics().telemetry);
}

TEST_F(JointsTest, WithoutAConnectionACommandIsRefusedAndNotKept) {
  EXPECT_THAT(complaintOf<NetworkException>([&] {
                client().commandJoints({{1, 0}}, milliseconds(0));
              }),
              HasSubstr("has not been started"));
  ScriptedPeer peer = connectVersion2();
  client().commandJoints({{200, 0}}, milliseconds(300));
  EXPECT_EQ("J 0 1 44 1 0 200 0 0 0 0 0 0 0", version2_frames::textOf(peer.readRequest())) << "the first that is sent";
}

TEST_F(JointsTest, BeforeTheVersionIsKnownACommandIsRefused) {
  client().start();
  ScriptedPeer peer = server_.accept();
  expectCommand(&peer, 'X', 2);
  EXPECT_THAT(complaintOf<NetworkException>([&] {
                client().commandJoints({{1, 0}}, milliseconds(0));
              }),
              HasSubstr("not connected to"));
}

TEST_F(JointsTest, ATargetWithASpeedFirstLimitsItsJointOverEachConnection) {
  for (int i = 0; i < 2; ++i) {
    ScriptedPeer peer = connectVersion2();
    ASSERT_TRUE(eventually([&] { return client().status().state == ConnectionState::kConnected; }));
    client().commandJoints({{1, 0.1, 2.0}, {2, 0.1}, {4, 0.1, 0.5}}, milliseconds(0));
    EXPECT_EQ("V 0 1 0 0 0 0 30 132 128 4 0 0 0 0 7 161 32", version2_frames::textOf(peer.readRequest()))
        << "joint 1 at 2 rad/s, joint 4 at 0.5 rad/s";
    EXPECT_EQ('J', peer.readRequest().header.kind);
    client().commandJoints({{1, 0.2, 2.0}}, milliseconds(0));
    EXPECT_EQ('J', peer.readRequest().header.kind) << "the robot has the limit";
    peer.close();
    ASSERT_TRUE(recorder_.waitForState(ConnectionState::kDisconnected));
  }
}

TEST_F(JointsTest, AServerWithoutJointsGetsNoCommandsToThem) {
  {
    ScriptedPeer peer = connectVersion2("F W");
    EXPECT_THAT(complaintOf<CommandException>([&] {
                  client().commandJoints({{1, 0}}, milliseconds(0));
                }),
                HasSubstr("(a test 1.0) does not take the request 'J'"));
  }
  ScriptedPeer peer = connectVersion2("F W J");
  ASSERT_TRUE(eventually([&] { return client().status().robot.hasCapability("J"); }));
  EXPECT_THAT(complaintOf<CommandException>([&] {
                client().commandJoints({{1, 0, 1.0}}, milliseconds(0));
              }),
              HasSubstr("does not take the request 'V'"));
}

TEST_F(JointsTest, TheStateOfTheMotorsIsThatOfTheRobotNotTheOneAskedFor) {
  ScriptedPeer peer = connectVersion2();
  for (const bool wanted : {true, false}) {
    auto state = std::async(std::launch::async, [&] { return client().setMotors(wanted, seconds(20)); });
    const std::uint8_t said = wanted ? 0 : 1;
    const version2_frames::Frame request = peer.readRequest();
    EXPECT_THAT(request.payload, ElementsAre(wanted ? 1 : 0));
    peer.send(makeFrame('o', request.header.request_number, {said}));
    EXPECT_EQ(state.get(), !wanted);
  }
}

TEST_F(JointsTest, OrdersAreSentWithTheirValues) {
  ScriptedPeer peer = connectVersion2("V I F");
  client().setJointSpeedLimits({{1, 0.5}, {2, 1.25}});
  const version2_frames::Frame limits = peer.readRequest();
  EXPECT_EQ('V', limits.header.kind);
  EXPECT_THAT(limits.payload, ElementsAre(1, 0, 0, 0, 0x00, 0x07, 0xa1, 0x20, 2, 0, 0, 0, 0x00, 0x13, 0x12, 0xd0));
  for (const std::vector<int>& joints : {std::vector<int>{2, 1}, std::vector<int>{}}) {
    auto held = std::async(std::launch::async, [&] { client().hold(joints, seconds(20)); });
    const version2_frames::Frame request = peer.readRequest();
    EXPECT_EQ(joints.empty() ? 0 : 1, request.header.id);
    EXPECT_EQ(joints, std::vector<int>(request.payload.begin(), request.payload.end()));
    peer.send(makeFrame('i', request.header.request_number, {}));
    held.get();
  }
  auto taken =
      std::async(std::launch::async, [&] { client().takePicture(37, seconds(20), nullptr, Resolution::kDouble); });
  const version2_frames::Frame request = peer.readRequest();
  EXPECT_EQ(37, request.header.id);
  EXPECT_THAT(request.payload, ElementsAre(3));
  peer.close();
  EXPECT_THROW(taken.get(), NetworkException);
}

TEST_F(JointsTest, EachOrderHasItsNumberAndItsTime) {
  ScriptedPeer peer = connectVersion2("J S E P");
  const auto refuse = [&peer](char kind) {
    const version2_frames::Frame request = peer.readRequest();
    EXPECT_EQ(kind, request.header.kind);
    const std::string reason(1, kind);
    peer.send(makeFrame('e', request.header.request_number, version2_frames::makeError(3, reason)));
  };
  const auto time_out = [](const auto& call) {
    for (milliseconds time(20); time < seconds(20); time *= 2) {
      try {
        call(time);
      } catch (const TimeoutException& error) {
        if (error.wasSent()) {
          return;
        }
      }
    }
  };
  using TimePoint = std::chrono::steady_clock::time_point;
  const TimePoint never = TimePoint::max();
  client().commandJoints({{1, 0.1}}, milliseconds(0), {never, 71});
  refuse('J');
  client().steer({0.1, 0, 0}, {never, 72});
  refuse('S');
  time_out([&](milliseconds time) { client().takePosture(Posture::kSit, time, {never, 73}); });
  refuse('E');
  time_out([&](milliseconds time) { client().playMotion("NOD.MTN", 1, time, {never, 74}); });
  refuse('P');
  const std::string address = "127.0.0.1:" + std::to_string(server_.port());
  std::string told = "71:J; 72:S; late 73:" + address + " refused to take the posture sit: E.; late 74:" + address +
                     " refused to play the motion NOD.MTN: P.; ";
  const auto expect_told = [&] { EXPECT_TRUE(eventually([&] { return recorder_.orders() == told; })) << told; };
  expect_told();
  const OrderTerms too_old = {TimePoint(), 75};
  const auto complaint = HasSubstr("is too old: it could not be sent to " + address + " in time.");
  EXPECT_THAT(complaintOf<CommandException>([&] { client().takePosture(Posture::kSit, seconds(20), too_old); }),
              complaint);
  EXPECT_THAT(complaintOf<CommandException>([&] { client().playMotion("NOD.MTN", 1, seconds(20), too_old); }),
              complaint);
  client().commandJoints({{2, 0.1}}, milliseconds(0), too_old);
  client().steer({0, 0.1, 0}, {TimePoint(), 76});
  for (const char* const order : {"75", "76"}) {
    told += std::string(order) + ":too old: it could not be sent to " + address + " in time; ";
  }
  expect_told();
}

TEST_F(JointsTest, ARobotsReportStaysInTheStatusUntilTheNextConnection) {
  ScriptedPeer peer = connectVersion2();
  peer.send(makeFrame('e', 0, version2_frames::makeError(3, "joint head_pan does not move")));
  peer.close();
  EXPECT_TRUE(recorder_.waitForStatus([](const ConnectionStatus& status) {
    return status.state != ConnectionState::kConnected && status.robot_message == "joint head_pan does not move";
  }));
  const ScriptedPeer next = connectVersion2();
  EXPECT_TRUE(eventually([&] { return client().status().robot_message.empty(); }));
}

TEST_F(JointsTest, ArgumentsAreChecked) {
  EXPECT_THROW(client().commandJoints({{0, 0}}, milliseconds(0)), InvalidArgumentException);
  EXPECT_THROW(client().commandJoints({{1, 0, -1}}, milliseconds(0)), InvalidArgumentException);
  EXPECT_THROW(client().setJointSpeedLimits({}), InvalidArgumentException);
  EXPECT_THROW(client().setTelemetryPeriod(-1), InvalidArgumentException);
  EXPECT_THROW(client().setTelemetryPeriod(65536), InvalidArgumentException);
  EXPECT_THROW(client().setMotors(true, milliseconds(0)), InvalidArgumentException);
  EXPECT_THROW(client().hold({0}, seconds(1)), InvalidArgumentException);
  EXPECT_THROW(client().hold({2, 2}, seconds(1)), InvalidArgumentException);
  EXPECT_THROW(client().hold({2}, seconds(1)), NetworkException);
}

TEST_F(JointsTest, AServerThatCannotHoldIsNotAsked) {
  {
    ScriptedPeer peer = connectVersion2("F W J V T L K");
    EXPECT_THAT(complaintOf<CommandException>([&] { client().hold({}, seconds(20)); }),
                HasSubstr("(a test 1.0) has no request to hold joints; send the joints to where they were commanded"));
  }
  ScriptedPeer peer = connectVersion1();
  ASSERT_TRUE(eventually([&] { return client().status().protocol_version == 1; }));
  EXPECT_THAT(complaintOf<CommandException>([&] { client().hold({}, seconds(20)); }),
              HasSubstr("speaks version 1 of the protocol, which has no request to hold joints; send the joints"));
}

// The client's thread is kept in a callback, so that it finds both orders at once.
TEST_F(JointsTest, AJointCommandIsNotSentAfterAHoldThatCameAfterIt) {
  std::mutex gate;
  std::atomic<bool> waits{false};
  Callbacks callbacks = recorder_.callbacks();
  callbacks.on_telemetry = [&](const Telemetry&) {
    waits = true;
    const std::lock_guard<std::mutex> lock(gate);
  };
  RcServerClient client(optionsFor(server_), callbacks);
  client.start();
  ScriptedPeer peer = server_.accept();
  peer.agreeToVersion2("J L I");
  ASSERT_TRUE(recorder_.waitForState(ConnectionState::kConnected));
  const auto answer = [&peer] {
    const version2_frames::Frame frame = peer.readRequest();
    peer.send(makeFrame(protocol::version2::replyKind(frame.header.kind), frame.header.request_number, frame.payload));
    return frame.header.kind;
  };
  char first = 'J';
  for (int i = 0; i < 20 && first == 'J'; ++i) {  // it is sent if the thread of hold() came too late
    std::unique_lock<std::mutex> lock(gate);
    waits = false;
    ASSERT_TRUE(eventually([&] {
      peer.send(makeFrame('t', 0, version2_frames::makeTelemetry(7, {{'J', 1, 0}})));
      return waits.load();
    }));
    client.commandJoints({{1, 0.1}}, milliseconds(0));
    auto held = std::async(std::launch::async, [&client] { client.hold({}, seconds(20)); });
    EXPECT_EQ(std::future_status::timeout, held.wait_for(milliseconds(20 + 50 * i)));
    lock.unlock();
    first = answer();
    EXPECT_EQ('I', first == 'J' ? answer() : first);
    held.get();
  }
  client.commandLeds({{7, 1}});
  EXPECT_EQ('L', answer());
}

}  // namespace
