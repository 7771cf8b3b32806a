#include <dirent.h>
#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <thread>

#include "client/tcp_transport.h"
#include "client_fixture.h"

using namespace aibo_client;
using std::chrono::milliseconds;
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

class ConnectionFaultsTest : public ClientFixture {
 protected:
  /// The client drops the connection, says why, comes back, asks for its stream again, and gets it.
  void expectRecovery(ScriptedPeer* peer, const std::string& reason) {
    EXPECT_TRUE(recorder_.waitForReason(reason)) << client_.status().reason;
    peer->waitUntilClosed();
    const std::size_t pictures = recorder_.pictures().size();
    ScriptedPeer next = acceptStream();
    const Bytes jpeg = test_pictures::makeNumbered(4711);
    sendUntilDelivered(&next, jpeg);
    ASSERT_TRUE(recorder_.waitForPictures(pictures + 1));
    EXPECT_EQ(jpeg, recorder_.pictures().back()->jpeg);
    EXPECT_EQ("", client_.status().reason);
    EXPECT_EQ("", client_.status().advice);
  }

  void expectProtocolError(const Bytes& bytes, const std::string& reason) {
    ScriptedPeer peer = startStream();
    sendUntilDelivered(&peer, test_pictures::makeNumbered(1));
    peer.send(bytes);
    expectRecovery(&peer, reason);
    EXPECT_EQ(1u, client_.statistics().protocol_errors);
    EXPECT_EQ(2u, client_.statistics().pictures);
  }
};

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

TEST_F(ConnectionFaultsTest, ReasonsThatAlternateAreLoggedOnceEach) {
  client_.start();
  for (int i = 0; i < 5; ++i) {
    server_.accept().close();
    ASSERT_TRUE(
        eventually([&] { return client_.status().reason.find("as soon as it was made") != std::string::npos; }));
    server_.vanish();
    ASSERT_TRUE(eventually([&] { return client_.status().reason.find("refused") != std::string::npos; }));
    server_.listen();
  }
  EXPECT_EQ(2, recorder_.logged("No connection to the robot"));
}

TEST_F(ConnectionFaultsTest, AReasonIsLoggedAgainAfterAConnectionThatWorked) {
  client_.setStreaming(true);
  client_.start();
  for (int connections = 1; connections <= 2; ++connections) {
    ScriptedPeer peer = acceptStream();
    sendUntilDelivered(&peer, test_pictures::make());
    peer.close();
    EXPECT_TRUE(eventually([&] { return recorder_.logged("closed the connection") == connections; }));
  }
}

// What the server sent over the connection before does not count.
TEST_F(ConnectionFaultsTest, AClientThatWasServedBeforeIsTurnedAwayLikeAnyOther) {
  ScriptedPeer peer = startStream();
  sendUntilDelivered(&peer, test_pictures::make());
  peer.close();
  ASSERT_TRUE(recorder_.waitForReason("closed the connection"));
  EXPECT_EQ(FaultKind::kClosed, client_.status().fault);
  server_.accept().close();
  EXPECT_TRUE(eventually([&] { return client_.status().fault == FaultKind::kTurnedAway; }));
}

TEST_F(ConnectionFaultsTest, AServerThatClosesAfterItsFirstAnswerHasNotTurnedTheClientAway) {
  ClientOptions options = optionsFor(server_);
  options.protocol_version = 1;
  RcServerClient client(options, recorder_.callbacks());
  client.start();
  ScriptedPeer peer = server_.accept();
  expectCommand(&peer, 'F', 73);
  peer.sendPicture(test_pictures::make());
  ASSERT_TRUE(recorder_.waitForState(ConnectionState::kConnected));
  peer.close();
  ASSERT_TRUE(recorder_.waitForReason("closed the connection"));
  EXPECT_EQ(FaultKind::kClosed, client.status().fault);
}

// With the waits of a client that did not reach its robot five times, seven more attempts would take more than 20 s.
TEST(BackoffTest, TheWaitsBeginAgainAfterAConnectionThatWorked) {
  ScriptedServer server;
  Recorder recorder;
  ClientOptions options;
  options.port = server.port();
  options.read_timeout = std::chrono::seconds(10);
  options.reconnect_wait_min = milliseconds(10);
  options.reconnect_wait_max = std::chrono::seconds(60);
  RcServerClient client(options, recorder.callbacks());
  const auto fail = [&client](std::uint64_t times) {
    const std::uint64_t before = client.statistics().failed_attempts;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (client.statistics().failed_attempts < before + times && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(milliseconds(1));
    }
    return client.statistics().failed_attempts >= before + times;
  };
  server.vanish();
  client.start();
  ASSERT_TRUE(fail(5));
  server.listen();
  ScriptedPeer peer = server.accept();
  peer.agreeToVersion2();
  ASSERT_TRUE(recorder.waitForLog("Connected to"));
  server.vanish();
  peer.close();
  EXPECT_TRUE(fail(7));
}

// The wait is at least 200 ms. An attempt that gets no answer takes longer than the longest wait.
TEST(BackoffTest, AnAttemptThatTookLongNeedsNoWaitAfterIt) {
  using std::chrono::steady_clock;
  ScriptedServer full(ScriptedServer::Begin::kAbsent);
  full.listen(0);
  TcpTransport other;
  other.connect("127.0.0.1", full.port(), steady_clock::now() + std::chrono::seconds(10));
  ClientOptions options;
  options.port = full.port();
  options.connect_timeout = milliseconds(450);
  options.reconnect_wait_min = options.reconnect_wait_max = milliseconds(400);
  std::atomic<int> attempts{0};
  std::atomic<bool> came_at_once{false};
  Callbacks callbacks;
  callbacks.on_status = [&, failed = steady_clock::time_point()](const ConnectionStatus& status) mutable {
    const steady_clock::time_point now = steady_clock::now();
    if (status.state == ConnectionState::kConnecting) {
      came_at_once = came_at_once || now < failed + milliseconds(100);
      ++attempts;
    } else {
      failed = now;
    }
  };
  RcServerClient client(options, callbacks);
  client.start();
  while (!came_at_once && attempts <= 10) {
    std::this_thread::sleep_for(milliseconds(1));
  }
  EXPECT_TRUE(came_at_once);
  EXPECT_EQ(FaultKind::kNoAnswer, client.status().fault);
  EXPECT_EQ("127.0.0.1:" + std::to_string(full.port()) + " did not answer within 450 ms", client.status().reason);
}

// After a connection, the wait does not begin with the attempt that made it. A server that turns a
// client away closes its connection at once; this one is silent for longer.
TEST(BackoffTest, AConnectionThatLastedIsFollowedByAWaitAndWasNotTurnedAway) {
  ScriptedServer server;
  Recorder recorder;
  ClientOptions options;
  options.port = server.port();
  options.read_timeout = std::chrono::seconds(10);
  options.reconnect_wait_min = options.reconnect_wait_max = milliseconds(400);
  RcServerClient client(options, recorder.callbacks());
  client.start();
  ScriptedPeer peer = server.accept();
  EXPECT_EQ('X', peer.readCommand().command);
  std::this_thread::sleep_for(std::chrono::seconds(1));
  const auto closed = std::chrono::steady_clock::now();
  peer.close();
  const ScriptedPeer next = server.accept();
  EXPECT_GE(std::chrono::steady_clock::now() - closed, milliseconds(200));
  EXPECT_EQ(FaultKind::kClosed, client.status().fault);
}

TEST_F(ConnectionFaultsTest, AServerThatTurnsTheClientAwayProbablyServesAnotherOne) {
  client_.setStreaming(true);
  client_.start();
  for (int i = 0; i < 5; ++i) {
    server_.accept().close();
  }
  ASSERT_TRUE(recorder_.waitForReason("closed the connection as soon as it was made"));
  ScriptedPeer peer = acceptStream();
  sendUntilDelivered(&peer, test_pictures::make());
  EXPECT_EQ(1, recorder_.logged("Is another client connected?"));
}

TEST_F(ConnectionFaultsTest, ACloseOrResetAtAnyPointOfAReplyIsRecoveredFromAndTheCutPictureNeverDelivered) {
  const Bytes reply = test_pictures::makeReply(test_pictures::make());
  client_.setStreaming(true);
  client_.start();
  const auto size = static_cast<std::ptrdiff_t>(reply.size());
  for (const std::ptrdiff_t cut : {std::ptrdiff_t{1}, std::ptrdiff_t{2}, std::ptrdiff_t{4}, std::ptrdiff_t{5},
                                   std::ptrdiff_t{6}, size / 2, size - 1}) {
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
  EXPECT_EQ(15u, client_.statistics().connections);
}

TEST_F(ConnectionFaultsTest, OnlyASilentRobotCountsAsAStall) {
  ClientOptions options = optionsFor(server_);
  options.read_timeout = milliseconds(300);
  RcServerClient client(options, recorder_.callbacks());
  client.setStreaming(true);
  client.start();
  acceptStream().close();
  ASSERT_TRUE(recorder_.waitForReason("closed the connection"));
  EXPECT_EQ(0u, client.statistics().stalls);
  EXPECT_EQ(0u, client.statistics().failed_attempts) << "it was made";
  const ScriptedPeer silent = acceptStream();
  ASSERT_TRUE(recorder_.waitForReason("sent nothing for 300 ms"));
  EXPECT_EQ(FaultKind::kSilent, client.status().fault);
  EXPECT_GE(client.statistics().stalls, 1u);
  client.setStreaming(false);
  ScriptedPeer asked = accept();
  ASSERT_TRUE(recorder_.waitForState(ConnectionState::kConnected));
  auto call = std::async(std::launch::async, [&] { client.takePicture(30, milliseconds(20000)); });
  expectCommand(&asked, 'F', 30);
  EXPECT_THROW(call.get(), TimeoutException);
  EXPECT_EQ(0u, client.statistics().protocol_errors);
}

TEST_F(ConnectionFaultsTest, AWebServerIsNotTakenForAnRcServer) {
  const std::string answer = "HTTP/1.1 400 Bad Request\r\n";
  expectProtocolError(Bytes(answer.begin(), answer.end()), "does not speak the RCServer's protocol");
}

TEST_F(ConnectionFaultsTest, AnAnswerToNoRequestIsLoggedAndTheConnectionKept) {
  ScriptedPeer peer = startStream();
  peer.send({'j', 1, 0, 0});
  sendUntilDelivered(&peer, test_pictures::makeNumbered(1));
  EXPECT_EQ(1u, client_.statistics().connections);
  EXPECT_EQ(1, recorder_.logged("an answer to no request: 'j'"));
}

TEST_F(ConnectionFaultsTest, ManyReconnectsLeaveNoDescriptorBehind) {
  client_.setStreaming(true);
  client_.start();
  acceptStream().close();
  acceptStream().reset();
  std::size_t before = 0;
  for (int i = 0; i < 60; ++i) {
    ScriptedPeer peer = acceptStream();
    before = before == 0 ? openDescriptors() : before;
    EXPECT_EQ(before, openDescriptors());
    switch (i % 3) {
      case 0:
        peer.close();
        break;
      case 1:
        peer.reset();
        break;
      default:
        peer.send({'?'});
        peer.waitUntilClosed();
    }
  }
}

TEST_F(ConnectionFaultsTest, FailedAttemptsLeaveNoDescriptorBehind) {
  server_.vanish();
  client_.start();
  ASSERT_TRUE(eventually([&] { return client_.statistics().failed_attempts >= 3; }));
  client_.stop();
  const std::size_t idle = openDescriptors();
  for (int round = 0; round < 5; ++round) {
    RcServerClient client(optionsFor(server_), {});
    client.start();
    ASSERT_TRUE(eventually([&] { return client.statistics().failed_attempts >= 5; }));
  }
  EXPECT_EQ(idle, openDescriptors());
}

}  // namespace
