// How the client comes back to a server that may not know yet that the old connection is dead.
#include <gmock/gmock.h>

#include <string>

#include "newest_client_fixture.h"
#include "protocol/introduction.h"
#include "support/version2_frames.h"

using namespace aibo_driver;
using test_pictures::Bytes;
using version2_frames::makeFrame;

namespace {

constexpr char kToken[] = "0123456789abcdef";

class ComingBackTest : public NewestClientFixture {
 protected:
  static Bytes helloWithToken(const std::string& token) {
    Bytes hello = version2_frames::makeHello("F W");
    const std::string line = "token=" + token + "\n";
    hello.insert(hello.end(), line.begin(), line.end());
    return hello;
  }

  /// Serves a client that has no token yet, and gives it one.
  void serveFirst() {
    client().start();
    ScriptedPeer peer = server_.accept();
    expectCommand(&peer, 'X', 2);
    peer.send({'x', 2, 0, 0});
    peer.send(makeFrame('h', peer.readFrame().header.request_number, helloWithToken(kToken)));
    EXPECT_TRUE(recorder_.waitForState(ConnectionState::kConnected));
    peer.close();
    EXPECT_TRUE(recorder_.waitForState(ConnectionState::kDisconnected));
  }
};

TEST_F(ComingBackTest, TheClientIntroducesItselfInOnePieceWithTheTokenOfTheLastHello) {
  serveFirst();
  ScriptedPeer peer = server_.accept();
  Bytes expected(protocol::version2::INTRODUCTION_SIZE);
  protocol::version2::encodeIntroduction(kToken, expected.data());
  EXPECT_EQ(expected, peer.read(expected.size()));
  peer.send({'x', 2, 0, 0});
  peer.send(makeFrame('h', 1, helloWithToken("fedcba9876543210")));
  ASSERT_TRUE(recorder_.waitForState(ConnectionState::kConnected));
  client().setStreaming(true);
  const version2_frames::Frame stream = peer.readRequest();
  EXPECT_EQ('W', stream.header.kind);
  EXPECT_GT(stream.header.request_number, 1);
  peer.close();
  ScriptedPeer again = server_.accept();
  protocol::version2::encodeIntroduction("fedcba9876543210", expected.data());
  EXPECT_EQ(expected, again.read(expected.size()));
}

TEST_F(ComingBackTest, TheTokenIsNeverLogged) {
  serveFirst();
  server_.accept().reset();
  ScriptedPeer peer = server_.accept();
  peer.read(protocol::version2::INTRODUCTION_SIZE);
  peer.send({'x', 2, 0, 0});
  peer.send(makeFrame('e', 1, version2_frames::makeError(0, "no")));
  peer.waitUntilClosed();
  EXPECT_EQ(0, recorder_.logged(kToken));
  EXPECT_EQ(0, recorder_.logged("token"));
  EXPECT_EQ(std::string::npos, client().status().reason.find(kToken));
}

TEST_F(ComingBackTest, AnotherServerThatSpeaksVersion1IsAskedAgainWithoutTheToken) {
  serveFirst();
  ScriptedPeer other = server_.accept();
  other.read(protocol::version2::INTRODUCTION_SIZE);
  other.send({'e', 0, 0, 0});
  other.waitUntilClosed();
  ScriptedPeer peer = server_.accept();
  expectCommand(&peer, 'X', 2);
  peer.send({'e', 0, 0, 0});
  ASSERT_TRUE(recorder_.waitForState(ConnectionState::kConnected));
  EXPECT_EQ(1, client().status().protocol_version);
  EXPECT_FALSE(peer.readCommandWithin(std::chrono::milliseconds(50))) << "nothing is sent to it unasked";
}

TEST_F(ComingBackTest, ATokenIsForgottenWhenTheServerGivesNone) {
  serveFirst();
  ScriptedPeer older = server_.accept();
  older.read(protocol::version2::INTRODUCTION_SIZE);
  older.send({'x', 2, 0, 0});
  older.send(makeFrame('h', 1, version2_frames::makeHello("F W")));
  ASSERT_TRUE(recorder_.waitForState(ConnectionState::kConnected));
  older.close();
  ScriptedPeer peer = server_.accept();
  expectCommand(&peer, 'X', 2);
  peer.send({'x', 2, 0, 0});
  EXPECT_TRUE(peer.readFrame().payload.empty());
}

TEST_F(ComingBackTest, NothingIsSaidOfARobotThatIsNotConnected) {
  ScriptedPeer peer = connectVersion2();
  EXPECT_EQ("ERS-7", client().status().robot.design);
  peer.close();
  ASSERT_TRUE(recorder_.waitForState(ConnectionState::kDisconnected));
  const ConnectionStatus status = client().status();
  EXPECT_EQ(0, status.protocol_version);
  EXPECT_EQ("", status.robot.design);
  EXPECT_FALSE(status.robot.hasCapability("F"));
}

TEST_F(ComingBackTest, AServerWithoutTokensIsAskedAsBefore) {
  connectVersion2().close();
  EXPECT_TRUE(recorder_.waitForState(ConnectionState::kDisconnected));
  ScriptedPeer peer = server_.accept();
  peer.agreeToVersion2();
  EXPECT_TRUE(recorder_.waitForState(ConnectionState::kConnected));
}

}  // namespace
