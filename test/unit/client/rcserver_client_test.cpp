// What a user sees of a connection: RcServerClient and Callbacks.
#include "aibo_client/rcserver_client.h"

#include <stdexcept>

#include "client_fixture.h"
#include "datagrams_fixture.h"
#include "support/udp_socket.h"

using namespace aibo_client;
using std::chrono::milliseconds;
using test_support::kSafetyNet;
using testing::HasSubstr;
using version2_frames::makeFrame;

namespace {

class RcServerClientTest : public ClientFixture {};

TEST_F(RcServerClientTest, AConnectionThatWorksHasNoReasonAndNoAdvice) {
  ScriptedPeer peer = startStream();
  sendUntilDelivered(&peer, test_pictures::makeNumbered(1));
  EXPECT_EQ(test_pictures::makeNumbered(1), recorder_.reports().pictures.at(0)->jpeg);
  EXPECT_GT(client_.statistics().bytes_received, 1000u);
  const std::string connected = "Connected to 127.0.0.1:" + std::to_string(server_.port());
  EXPECT_TRUE(eventually([&] { return recorder_.logged(connected) == 1; }));
  const ConnectionStatus status = client_.status();
  EXPECT_EQ(ConnectionState::kConnected, status.state);
  EXPECT_EQ(1, status.protocol_version);
  EXPECT_EQ("", status.reason);
  EXPECT_EQ("", status.advice);
  EXPECT_EQ(0, recorder_.logged("No connection"));
}

TEST_F(RcServerClientTest, NothingIsSaidOfARobotThatIsNotConnected) {
  ScriptedPeer peer = connectVersion2();
  EXPECT_EQ(2u, client_.status().robot.joint_limits.size());
  EXPECT_EQ("ERS-7", client_.robotDesign());
  peer.send(makeFrame('o', 0, {1, protocol::version2::POSTURE_SIT, 0, 0}));
  EXPECT_TRUE(eventually([&] { return client_.motorsAndPosture().motors == MotorState::kOn; }));
  peer.close();
  ASSERT_TRUE(recorder_.waitForState(ConnectionState::kDisconnected));
  EXPECT_TRUE(client_.motorsAndPosture() == MotorsAndPosture());
  const ConnectionStatus status = client_.status();
  EXPECT_EQ(0, status.protocol_version);
  EXPECT_EQ("", status.robot.design);
  EXPECT_FALSE(status.robot.hasCapability("F"));
}

// The user forgets what a robot does that is not connected.
TEST_F(RcServerClientTest, TellsOfTheConnectionBeforeItTellsOfMotorsAndPosture) {
  std::vector<ConnectionState> states;
  const RcServerClient* asked = nullptr;
  Callbacks callbacks;
  callbacks.on_motors_and_posture = [&](const MotorsAndPosture&) { states.push_back(asked->status().state); };
  RcServerClient client(optionsFor(server_), callbacks);
  asked = &client;
  client.start();
  ScriptedPeer peer = server_.accept();
  peer.agreeToVersion2(kCapabilities, makeFrame('o', 0, {1, protocol::version2::POSTURE_SIT, 0, 0}));
  EXPECT_TRUE(eventually([&] { return client.motorsAndPosture().motors == MotorState::kOn; }));
  client.stop();
  ASSERT_EQ(2u, states.size()) << "and once more at the end of the connection";
  EXPECT_EQ(ConnectionState::kConnected, states.front());
}

TEST_F(RcServerClientTest, EachConnectionHasTheNextNumber) {
  for (const unsigned number : {1u, 2u}) {
    ScriptedPeer peer = connectVersion2();
    peer.send(makeFrame('t', 0, version2_frames::makeTelemetry(7, {{'J', 1, 0}})));
    ASSERT_TRUE(eventually([&] { return recorder_.reports().telemetry.size() == number; }));
    EXPECT_EQ(number, recorder_.reports().telemetry.back().connection_number);
    EXPECT_EQ(number, client_.statistics().telemetry);
    EXPECT_EQ(number, client_.statistics().connections);
  }
}

TEST_F(RcServerClientTest, TellsWhenTheStreamGoesOnOrOffAlsoByTheEndOfAConnection) {
  ScriptedPeer peer = startStream();
  const auto tells = [this](const std::vector<bool>& changes) {
    return eventually([&] { return recorder_.reports().streaming == changes; });
  };
  EXPECT_TRUE(tells({true}));
  EXPECT_TRUE(client_.streaming());
  client_.setStreaming(false);
  EXPECT_TRUE(tells({true, false}));
  client_.setStreaming(true);
  EXPECT_TRUE(tells({true, false, true}));
  peer.close();
  EXPECT_TRUE(tells({true, false, true, false}));
}

TEST_F(RcServerClientTest, ACallbackThatThrowsIsLoggedAndTheStreamGoesOn) {
  Recorder recorder;
  Callbacks callbacks = recorder.callbacks();
  callbacks.on_picture = [record = callbacks.on_picture](const PicturePtr& picture) {
    record(picture);
    throw std::runtime_error("the disk is full");
  };
  RcServerClient client(optionsFor(server_), callbacks);
  client.setStreaming(true);
  client.start();
  ScriptedPeer peer = acceptStream();
  for (int i = 0; i < 2; ++i) {
    sendUntilDelivered(client, [&] { peer.sendPicture(test_pictures::make()); });
  }
  EXPECT_TRUE(eventually([&] { return recorder.logged("on_picture threw an exception: the disk is full") == 2; }));
}

TEST_F(RcServerClientTest, ConnectsOnceIfStartedTwice) {
  client_.start();
  client_.start();
  ScriptedPeer peer = accept();
  EXPECT_FALSE(server_.clientComesWithin(milliseconds(50)));
}

TEST_F(RcServerClientTest, WithVersion1AsAnOptionTheServerIsNotAskedForItsVersion) {
  ClientOptions options = optionsFor(server_);
  options.protocol_version = 1;
  RcServerClient client(options, recorder_.callbacks());
  client.start();
  ScriptedPeer peer = server_.accept();
  expectCommand(&peer, 'F', 73);
  EXPECT_EQ(ConnectionState::kConnecting, client.status().state) << "it has not answered";
}

TEST_F(RcServerClientTest, AServerThatDoesNotAnswerToVersion2IsAskedForAPicture) {
  client_.start();
  ScriptedPeer peer = server_.accept();
  expectCommand(&peer, 'X', 2);
  expectCommand(&peer, 'F', 73);
  peer.sendPicture(test_pictures::make());
  EXPECT_TRUE(recorder_.waitForState(ConnectionState::kConnected));
  EXPECT_EQ(1, client_.status().protocol_version);
}

TEST_F(RcServerClientTest, DatagramsOfAnotherAddressAreOnlyCounted) {
  client_.setStreaming(true);
  client_.setPictureTransport(PictureTransport::kUdp);
  ScriptedPeer peer = connectVersion2("F W B");
  test_support::UdpSocket robot("127.0.0.1");
  protocol::version2::DatagramOrder order = {};
  const auto read_order = [&] {
    version2_frames::Frame request = peer.readRequest();
    for (; request.header.kind != 'B'; request = peer.readRequest()) {
    }
    EXPECT_EQ(nullptr, decode(request.payload.data(), request.payload.size(), &order));
  };
  for (read_order(); order.is_test; read_order()) {
    test_pictures::Bytes test(protocol::version2::MAX_DATAGRAM_SIZE);
    protocol::version2::encodeTest(order, test.data());
    robot.send(order.port, test);
  }
  test_support::UdpSocket stranger("127.0.0.2");
  stranger.send(order.port, makeDatagrams(makeJpeg(1), order.first_picture, 1000, &order.first_sequence)[0]);
  robot.send(order.port, {'?'});
  EXPECT_TRUE(eventually([this] { return client_.statistics().bad_datagrams == 1; }));
  EXPECT_EQ(1u, client_.statistics().foreign_datagrams);
  EXPECT_EQ(0u, client_.statistics().datagrams);
  EXPECT_EQ(PictureTransport::kUdp, client_.status().wanted_transport);
}

TEST_F(RcServerClientTest, WhatARobotSaidBeforeItWentOffStaysUntilItAnswersAgain) {
  ScriptedPeer peer = connectVersion2();
  peer.send(makeFrame('e', 0, version2_frames::makeError(4, "the battery is low")));
  peer.close();
  const auto says = [this](const std::string& fault) {
    const std::string address = "127.0.0.1:" + std::to_string(server_.port());
    const std::string reason = "the robot said: the battery is low; since then, " + address + " " + fault;
    EXPECT_TRUE(eventually([&] { return client_.status().reason == reason; })) << client_.status().reason;
    return client_.status().robot_message == "the battery is low";
  };
  EXPECT_TRUE(says("closed the connection"));
  EXPECT_EQ(client_.status().fault, FaultKind::kClosed);
  server_.accept().close();
  EXPECT_TRUE(says("closed the connection as soon as it was made"));
  EXPECT_THAT(client_.status().advice, testing::StartsWith("Switch it on again, with a charged battery."));
  server_.vanish();
  EXPECT_TRUE(says("refused the connection"));
  server_.listen();
  ScriptedPeer again = connectVersion2();
  EXPECT_EQ(client_.status().reason, "");
  EXPECT_TRUE(eventually([&] { return client_.status().robot_message.empty(); }));
  again.close();
  EXPECT_TRUE(eventually([&] { return client_.status().fault == FaultKind::kClosed; }));
  EXPECT_THAT(client_.status().reason, testing::Not(HasSubstr("battery")));
}

// If the waits went on growing, seven more attempts would take longer than the safety net.
TEST_F(RcServerClientTest, TheWaitsBeginAgainAfterAConnectionThatWorked) {
  ClientOptions options = optionsFor(server_);
  options.reconnect_wait_max = std::chrono::seconds(60);
  RcServerClient patient(options, recorder_.callbacks());
  const auto fails_seven_times = [&patient] {
    const std::uint64_t before = patient.statistics().failed_attempts;
    return eventually([&] { return patient.statistics().failed_attempts >= before + 7; });
  };
  server_.vanish();
  patient.start();
  ASSERT_TRUE(fails_seven_times());
  server_.listen();
  ScriptedPeer peer = server_.accept();
  peer.agreeToVersion2();
  patient.waitForConnection(kSafetyNet);
  server_.vanish();
  peer.close();
  EXPECT_TRUE(fails_seven_times());
}

TEST_F(RcServerClientTest, AServerThatTurnsTheClientAwayProbablyServesAnotherOne) {
  client_.setStreaming(true);
  client_.start();
  for (int i = 0; i < 5; ++i) {
    server_.accept().close();
  }
  ASSERT_TRUE(eventually([&] { return recorder_.logged("closed the connection as soon as it was made") > 0; }));
  EXPECT_TRUE(eventually([&] { return client_.status().fault == FaultKind::kTurnedAway; }));
  ScriptedPeer peer = acceptStream();
  sendUntilDelivered(&peer, test_pictures::make());
  EXPECT_EQ(1, recorder_.logged("Is another client connected?"));
}

struct Failure {
  FaultKind kind;
  bool was_sent;
  std::string text;
};

class ACallThatWaits : public ClientFixture {
 protected:
  static Failure failureOf(const std::function<void()>& call) {
    try {
      call();
    } catch (const NetworkException& error) {
      return {error.kind(), error.wasSent(), error.what()};
    }
    return {FaultKind::kInternal, false, "no failure"};
  }
};

TEST_F(ACallThatWaits, FailsAtOnceWithoutAConnectionAndSaysWhatToCheck) {
  const auto fail = [this] { return failureOf([this] { client_.takePicture(0, kSafetyNet); }); };
  server_.vanish();
  client_.start();
  ASSERT_TRUE(eventually([&] { return recorder_.logged("refused") > 0; }));
  EXPECT_THAT(fail().text,
              testing::AllOf(HasSubstr("refused the connection"), HasSubstr("Is the RCServer running there")));
  EXPECT_EQ(FaultKind::kRefused, fail().kind);
  EXPECT_EQ(FaultKind::kRefused, client_.status().fault);
  EXPECT_FALSE(fail().was_sent);
  EXPECT_THAT(failureOf([&] { client_.waitForConnection(milliseconds(1)); }).text, HasSubstr("refused"));
  auto waiting = std::async(std::launch::async, [&] { client_.waitForConnection(kSafetyNet); });
  server_.listen();
  const ScriptedPeer peer = accept();
  waiting.get();
  EXPECT_EQ(ConnectionState::kConnected, client_.status().state);
  EXPECT_EQ(FaultKind::kNone, client_.status().fault);
  EXPECT_EQ("", client_.status().advice);
}

TEST_F(ACallThatWaits, FailsWithItsConnectionAndNamesTheReason) {
  for (const bool is_closed : {true, false}) {
    ScriptedPeer peer = connectVersion1();
    EXPECT_TRUE(eventually([this] { return client_.status().state == ConnectionState::kConnected; }));
    auto taken = std::async(std::launch::async, [this] { return client_.takePicture(40, kSafetyNet); });
    expectCommand(&peer, 'F', 40);
    is_closed ? peer.close() : peer.send({'?'});
    const Failure failure = failureOf([&taken] { taken.get(); });
    EXPECT_EQ(is_closed ? FaultKind::kClosed : FaultKind::kProtocol, failure.kind);
    EXPECT_TRUE(failure.was_sent);
    EXPECT_THAT(failure.text, HasSubstr(is_closed ? "closed the connection. Was the robot"
                                                  : "does not speak the RCServer's protocol"));
  }
  EXPECT_EQ(1u, client_.statistics().protocol_errors);
}

TEST_F(ACallThatWaits, HasNoFaultOfItsOwnWhenItsTimeIsOverButItsConnectionHas) {
  const ScriptedPeer peer = connectVersion1();
  EXPECT_EQ(FaultKind::kNone, failureOf([this] { client_.takePicture(40, milliseconds(100)); }).kind);
  EXPECT_TRUE(eventually([this] { return client_.status().fault == FaultKind::kSilent; }));
  EXPECT_THAT(client_.status().reason, HasSubstr("did not answer the request to take a picture within 100 ms"));
  EXPECT_EQ(1u, client_.statistics().stalls);
}

}  // namespace
