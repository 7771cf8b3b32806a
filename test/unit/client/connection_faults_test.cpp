#include <gmock/gmock.h>

#include <chrono>

#include "client_fixture.h"
#include "support/resources.h"

using namespace aibo_client;
using test_pictures::Bytes;
using test_support::Resources;

namespace {

class ConnectionFaultsTest : public ClientFixture {};

TEST_F(ConnectionFaultsTest, WhatARobotSaidBeforeItWentOffStaysUntilItAnswersAgain) {
  ScriptedPeer peer = connectVersion2();
  peer.send(version2_frames::makeFrame('e', 0, version2_frames::makeError(4, "the battery is low")));
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
  EXPECT_THAT(client_.status().reason, testing::Not(testing::HasSubstr("battery")));
}

// If the waits went on growing, seven more attempts would take longer than the safety net.
TEST_F(ConnectionFaultsTest, TheWaitsBeginAgainAfterAConnectionThatWorked) {
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
  patient.waitForConnection(test_support::kSafetyNet);
  server_.vanish();
  peer.close();
  EXPECT_TRUE(fails_seven_times());
}

TEST_F(ConnectionFaultsTest, AServerThatTurnsTheClientAwayProbablyServesAnotherOne) {
  client_.setStreaming(true);
  client_.start();
  for (int i = 0; i < 5; ++i) {
    server_.accept().close();
  }
  ASSERT_TRUE(recorder_.waitForReason("closed the connection as soon as it was made"));
  EXPECT_TRUE(eventually([&] { return client_.status().fault == FaultKind::kTurnedAway; }));
  ScriptedPeer peer = acceptStream();
  sendUntilDelivered(&peer, test_pictures::make());
  EXPECT_EQ(1, recorder_.logged("Is another client connected?"));
}

TEST_F(ConnectionFaultsTest, LeaveNeitherDescriptorNorPartOfAPictureBehind) {
  const Bytes picture = test_pictures::makeReply(test_pictures::make());
  client_.setStreaming(true);
  client_.start();
  acceptStream().close();
  std::size_t before = 0;
  for (int i = 0; i < 30; ++i) {
    ScriptedPeer peer = acceptStream();
    before = before == 0 ? Resources::of().descriptors : before;
    EXPECT_EQ(before, Resources::of().descriptors);
    if (i % 3 == 2) {
      peer.send({'?'});
      peer.waitUntilClosed();
    } else {
      peer.send({picture.begin(), picture.end() - 1 - 50 * i});
      i % 3 == 0 ? peer.close() : peer.reset();
    }
  }
  EXPECT_TRUE(recorder_.pictures().empty());
  server_.vanish();
  const std::uint64_t failed = client_.statistics().failed_attempts;
  ASSERT_TRUE(eventually([&] { return client_.statistics().failed_attempts >= failed + 10; }));
  client_.stop();
  EXPECT_LE(Resources::of().descriptors, before);
}

}  // namespace
