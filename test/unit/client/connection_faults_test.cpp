#include <dirent.h>
#include <gmock/gmock.h>

#include <chrono>
#include <memory>
#include <optional>

#include "client_fixture.h"

using namespace aibo_client;
using test_pictures::Bytes;

namespace {

std::size_t openDescriptors() {
  const std::unique_ptr<DIR, int (*)(DIR*)> folder(::opendir("/proc/self/fd"), &::closedir);
  std::size_t count = 0;
  while (::readdir(folder.get()) != nullptr) {
    ++count;
  }
  return count;
}

class ConnectionFaultsTest : public ClientFixture {};

TEST_F(ConnectionFaultsTest, AServerThatAppearsLaterIsFound) {
  server_.vanish();
  client_.setStreaming(true);
  client_.start();
  ASSERT_TRUE(recorder_.waitForReason("refused the connection"));
  EXPECT_THAT(client_.status().advice, testing::HasSubstr("Is the RCServer running there"));
  server_.listen();
  ScriptedPeer peer = acceptStream();
  sendUntilDelivered(&peer, test_pictures::make());
  EXPECT_GE(client_.statistics().failed_attempts, 1u);
}

TEST_F(ConnectionFaultsTest, WhatARobotSaidBeforeItWentOffStaysUntilItAnswersAgain) {
  client_.start();
  const auto connect = [this] {
    ScriptedPeer peer = server_.accept();
    peer.agreeToVersion2();
    EXPECT_TRUE(recorder_.waitForState(ConnectionState::kConnected));
    return peer;
  };
  ScriptedPeer peer = connect();
  peer.send(version2_frames::makeFrame('e', 0, version2_frames::makeError(4, "the battery is low")));
  peer.close();
  const auto says = [this](const std::string& fault) {
    const std::string address = "127.0.0.1:" + std::to_string(server_.port());
    const std::string reason = "the robot said: the battery is low; since then, " + address + " " + fault;
    return eventually([&] { return client_.status().reason == reason; });
  };
  EXPECT_TRUE(says("closed the connection")) << client_.status().reason;
  EXPECT_EQ(client_.status().fault, FaultKind::kClosed);
  server_.accept().close();
  EXPECT_TRUE(says("closed the connection as soon as it was made")) << client_.status().reason;
  EXPECT_THAT(client_.status().advice, testing::StartsWith("Switch it on again, with a charged battery."));
  server_.vanish();
  EXPECT_TRUE(says("refused the connection")) << client_.status().reason;
  server_.listen();
  ScriptedPeer again = connect();
  EXPECT_EQ(client_.status().reason, "");
  again.close();
  EXPECT_TRUE(eventually([&] { return client_.status().fault == FaultKind::kClosed; }));
  EXPECT_THAT(client_.status().reason, testing::Not(testing::HasSubstr("battery")));
}

TEST_F(ConnectionFaultsTest, AWebServerIsNotTakenForAnRcServer) {
  ScriptedPeer peer = startStream();
  sendUntilDelivered(&peer, test_pictures::makeNumbered(1));
  const std::string answer = "HTTP/1.1 400 Bad Request\r\n";
  peer.send(Bytes(answer.begin(), answer.end()));
  EXPECT_TRUE(recorder_.waitForReason("does not speak the RCServer's protocol"));
  peer.waitUntilClosed();
  EXPECT_EQ(1u, client_.statistics().protocol_errors);
  EXPECT_EQ(0u, client_.statistics().stalls);
  ScriptedPeer next = acceptStream();
  sendUntilDelivered(&next, test_pictures::makeNumbered(2));
  EXPECT_EQ(test_pictures::makeNumbered(2), recorder_.pictures().back()->jpeg);
  EXPECT_EQ("", client_.status().reason);
  EXPECT_EQ("", client_.status().advice);
}

/// The longest wait is longer than the safety net.
class BackoffTest : public ConnectionFaultsTest {
 protected:
  BackoffTest() {
    ClientOptions options = optionsFor(server_);
    options.reconnect_wait_max = std::chrono::seconds(60);
    patient_.emplace(options, recorder_.callbacks());
  }
  bool failTimes(std::uint64_t times) {
    const std::uint64_t before = patient_->statistics().failed_attempts;
    return eventually([&] { return patient_->statistics().failed_attempts >= before + times; });
  }

  std::optional<RcServerClient> patient_;
};

// If the waits went on growing, seven more attempts would take longer than the safety net.
TEST_F(BackoffTest, TheWaitsBeginAgainAfterAConnectionThatWorked) {
  server_.vanish();
  patient_->start();
  ASSERT_TRUE(failTimes(7));
  server_.listen();
  ScriptedPeer peer = server_.accept();
  peer.agreeToVersion2();
  patient_->waitForConnection(test_support::kSafetyNet);
  server_.vanish();
  peer.close();
  EXPECT_TRUE(failTimes(7));
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

TEST_F(ConnectionFaultsTest, ACloseOrResetAtAnyPointOfAReplyIsRecoveredFromAndTheCutPictureNeverDelivered) {
  const Bytes reply = test_pictures::makeReply(test_pictures::make());
  client_.setStreaming(true);
  client_.start();
  const auto size = static_cast<std::ptrdiff_t>(reply.size());
  for (const std::ptrdiff_t cut : {std::ptrdiff_t{1}, std::ptrdiff_t{5}, size / 2, size - 1}) {
    for (const bool reset : {false, true}) {
      ScriptedPeer peer = acceptStream();
      peer.send(Bytes(reply.begin(), reply.begin() + cut));
      reset ? peer.reset() : peer.close();
    }
  }
  ScriptedPeer peer = acceptStream();
  sendUntilDelivered(client_, [&] { peer.send(reply); });
  EXPECT_EQ(1u, client_.statistics().pictures);
  EXPECT_EQ(0u, client_.statistics().corrupt_pictures);
  EXPECT_EQ(9u, client_.statistics().connections);
}

TEST_F(ConnectionFaultsTest, LeaveNoDescriptorBehind) {
  client_.setStreaming(true);
  client_.start();
  acceptStream().close();
  std::size_t before = 0;
  for (int i = 0; i < 30; ++i) {
    ScriptedPeer peer = acceptStream();
    before = before == 0 ? openDescriptors() : before;
    EXPECT_EQ(before, openDescriptors());
    if (i % 3 == 0) {
      peer.close();
    } else if (i % 3 == 1) {
      peer.reset();
    } else {
      peer.send({'?'});
      peer.waitUntilClosed();
    }
  }
  server_.vanish();
  const std::uint64_t failed = client_.statistics().failed_attempts;
  ASSERT_TRUE(eventually([&] { return client_.statistics().failed_attempts >= failed + 10; }));
  client_.stop();
  EXPECT_LE(openDescriptors(), before);
}

}  // namespace
