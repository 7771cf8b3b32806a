// What a user sees of a connection that works: RcServerClient and Callbacks.
#include "aibo_client/rcserver_client.h"

#include <gmock/gmock.h>

#include <future>
#include <stdexcept>
#include <string>

#include "client_fixture.h"

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
  EXPECT_EQ(test_pictures::makeNumbered(1), recorder_.pictures().at(0)->jpeg);
  EXPECT_GT(client_.statistics().bytes_received, 1000u);
  ASSERT_TRUE(recorder_.waitForLog("Connected to 127.0.0.1:" + std::to_string(server_.port())));
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

TEST_F(RcServerClientTest, EachConnectionHasTheNextNumber) {
  for (const unsigned number : {1u, 2u}) {
    ScriptedPeer peer = connectVersion2();
    peer.send(makeFrame('t', 0, version2_frames::makeTelemetry(7, {{'J', 1, 0}})));
    ASSERT_TRUE(recorder_.waitForTelemetry(number));
    EXPECT_EQ(number, recorder_.telemetry().back().connection_number);
    EXPECT_EQ(number, client_.statistics().telemetry);
    EXPECT_EQ(number, client_.statistics().connections);
  }
}

TEST_F(RcServerClientTest, TellsWhenTheStreamWasSwitchedOnOrOffAlsoByTheEndOfAConnection) {
  ScriptedPeer peer = startStream();
  EXPECT_TRUE(recorder_.waitForStreaming({true}));
  EXPECT_TRUE(client_.streaming());
  client_.setStreaming(false);
  EXPECT_TRUE(recorder_.waitForStreaming({true, false}));
  client_.setStreaming(true);
  EXPECT_TRUE(recorder_.waitForStreaming({true, false, true}));
  server_.vanish();
  peer.close();
  EXPECT_TRUE(recorder_.waitForStreaming({true, false, true, false}));
  EXPECT_FALSE(client_.streaming());
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

TEST_F(RcServerClientTest, EveryCallbackMayBeEmpty) {
  RcServerClient client(optionsFor(server_), {});
  client.setStreaming(true);
  client.start();
  ScriptedPeer peer = acceptStream();
  sendUntilDelivered(client, [&] { peer.sendPicture(test_pictures::make()); });
}

TEST_F(RcServerClientTest, WaitsForTheConnectionOrSaysWhyThereIsNone) {
  server_.vanish();
  client_.start();
  ASSERT_TRUE(recorder_.waitForReason("refused"));
  EXPECT_THAT(complaintOf<NetworkException>([&] { client_.waitForConnection(milliseconds(1)); }), HasSubstr("refused"));
  auto waiting = std::async(std::launch::async, [&] { client_.waitForConnection(kSafetyNet); });
  server_.listen();
  const ScriptedPeer peer = accept();
  waiting.get();
  EXPECT_EQ(ConnectionState::kConnected, client_.status().state);
}

TEST_F(RcServerClientTest, ConnectsOnceIfStartedTwice) {
  client_.start();
  client_.start();
  ScriptedPeer peer = accept();
  EXPECT_FALSE(server_.clientComesWithin(milliseconds(50)));
}

TEST_F(RcServerClientTest, ReadsWhatComesTogetherWithTheAnswerAboutTheVersion) {
  client_.start();
  ScriptedPeer peer = server_.accept();
  expectCommand(&peer, 'X', 2);
  peer.send({'e', 0, 0, 0, 'j', 1, 0, 0});
  EXPECT_TRUE(recorder_.waitForLog("an answer to no request: 'j'"));
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

}  // namespace
