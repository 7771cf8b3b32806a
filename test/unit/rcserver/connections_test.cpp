// Connections, and clients that are lost.

#include "rcserver_fixture.h"

namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// The header of a frame that no server takes.
const std::string kTooLarge("Z\0\0\1\0\1\0\1", 8);

class ConnectionsTest : public FakeRobotFixture {
 protected:
  void SetUp() override { start(); }

  bool isServed(TestClient& client) {
    client.send(kRefused);
    machine_->runPending();
    return client.next().has_value();
  }

  size_t timesSaid(const std::string& text) const {
    size_t count = 0;
    for (size_t at = console_.str().find(text); at != std::string::npos; at = console_.str().find(text, at + 1)) {
      ++count;
    }
    return count;
  }
};

TEST_F(ConnectionsTest, LastMessageArrivesAndTheClientHasTwoSecondsToCloseThen) {
  const auto client = connect();  // it does not close itself
  client->send(request('X', 2) + kTooLarge);
  machine_->runPending();
  passFrames(240);
  EXPECT_TRUE(client->next()) << "the agreement to version 2";
  const std::optional<Frame> last_word = client->nextFrame();
  ASSERT_TRUE(last_word);
  EXPECT_EQ(last_word->header.kind, 'e');
  EXPECT_TRUE(awaitEnd(*client));
  EXPECT_FALSE(client->wasReset());
  passFrames(20);
  EXPECT_TRUE(client->wasReset());
}

TEST_F(ConnectionsTest, ClientsTurnedAwayThatDoNotCloseDoNotKeepOthersOut) {
  auto served = connectServed();
  std::vector<std::unique_ptr<TestClient>> newcomers;
  for (int i = 0; i < 10; ++i) {
    newcomers.push_back(connect());
    passFrames(4);
    EXPECT_TRUE(newcomers.back()->ended()) << i;
    EXPECT_FALSE(newcomers.back()->next());
  }
  served->close();
  machine_->runPending();
  auto next = connect();
  EXPECT_TRUE(isServed(*next));
}

class Leaving : public TestClient {
 public:
  using TestClient::TestClient;
  void closeSendingSide() { ::shutdown(socket_.get(), SHUT_WR); }
};

TEST_F(ConnectionsTest, AClientThatClosesItsSendingSideCountsAsGone) {
  Leaving client(machine_->hostPort(protocol::RCSERVER_PORT));
  ask(client, "");
  client.closeSendingSide();
  EXPECT_TRUE(awaitEnd(client));
  EXPECT_TRUE(isServed(*connect()));
}

// What it has asked for after that waits, too.
TEST_F(ConnectionsTest, ClientThatClosesWhileTheStickIsAtWorkLeavesItsPlace) {
  file_keeper_.slowDown();
  client_ = connectServed();
  send(fileRequest('P', "NOD.MTN", 1));
  ASSERT_TRUE(file_keeper_.hasJob());
  for (int i = 0; i < 20; ++i) {
    send(request('S', 1));
  }
  disconnect();
  auto next = connect();
  EXPECT_TRUE(isServed(*next));
}

TEST_F(ConnectionsTest, WhatComesWhileTheMemoryStickIsAtWorkIsAnsweredAfterwards) {
  file_keeper_.slowDown();
  client_ = connectServed();
  client_->send(fileRequest('P', "NOD.MTN", 1));
  constexpr int kRequests = 1000;  // more than fit into the buffer
  for (int i = 0; i < kRequests; ++i) {
    send(kRefused);
  }
  EXPECT_FALSE(client_->next());
  file_keeper_.speedUp();
  takeImage();
  for (int i = 0; i < 1 + kRequests; ++i) {
    ASSERT_TRUE(await(*client_)) << i;
  }
}

// What would switch to version 2 and move a joint, and shut the robot down.
std::string commands() {
  return request('X', 2) + frame('J', 0, 1, order(targetsOf({{52, 900000}}))) + frame('Q', 0, 2) + request('Q', 0, 0);
}

std::string webPage(const std::string& method) {
  return method + " / HTTP/1.1\r\nHost: 127.0.0.1:54321\r\nContent-Type: text/plain\r\n\r\n" + commands();
}

// RFC 5389 and RFC 4571, as Chromium sends it to a "passive" candidate: the user name is the page's choice.
const std::string kStun("\0\x5c\0\1\0\x48\x21\x12\xa4\x42QJFUQAAQRAAR\0\x06\0\x0dQ///:XQQ/WUFU\0\0\0\x24\0\4", 44);

class StrangersTest : public ConnectionsTest {
 protected:
  void SetUp() override { startWith("ALLOW_SHUT_DOWN=yes\nALLOW_REBOOT=yes\nALLOWED_ADDRESSES=any\n"); }
};

TEST_F(StrangersTest, AreAbortedBeforeAByteIsHandledAndOthersAreServed) {
  const std::vector<int> before = positions();
  for (const std::string& bytes : {kStun + commands(), "\x16\x03\x01" + commands(), "q" + commands(), webPage("GET"),
                                   webPage("Q"), webPage("FUFU"), webPage("P" + std::string(3000, 'Q'))}) {
    auto stranger = connect();
    stranger->send(bytes);
    EXPECT_TRUE(awaitEnd(*stranger)) << bytes;
    EXPECT_TRUE(stranger->wasReset()) << bytes;
    EXPECT_EQ(stranger->received(), "") << bytes;
    passFrames(130);
    EXPECT_EQ(positions(), before) << bytes;
    client_ = connectServed();
    EXPECT_FALSE(client_->ended()) << bytes;
    disconnect();
  }
}

TEST_F(StrangersTest, AreCountedOnTheConsoleOnceAMinute) {
  const auto comeAsBrowsers = [this](int browsers) {
    for (int i = 0; i < browsers; ++i) {
      auto browser = connect();
      browser->send(webPage("POST"));
      EXPECT_TRUE(awaitEnd(*browser));
    }
    return timesSaid("is not a client");
  };
  EXPECT_EQ(comeAsBrowsers(100), 1U);
  passFrames(58 * 125);
  EXPECT_EQ(comeAsBrowsers(1), 1U);
  passFrames(2 * 125);
  EXPECT_EQ(comeAsBrowsers(1), 2U);
  EXPECT_EQ(timesSaid("101 such connections"), 1U);
}

TEST_F(ConnectionsTest, ClientsThatComeAndGoAreReportedOnceASecondAfterAFew) {
  for (int i = 0; i < 100; ++i) {
    client_ = connectServed();
    disconnect();
  }
  EXPECT_GE(timesSaid("is connected"), 9U) << "half of 20 lines";
  EXPECT_LT(timesSaid("\n"), 30U);
  passFrames(30 * 125);
  console_.str("");
  auto client = connect();
  EXPECT_TRUE(isServed(*client));
  EXPECT_THAT(console_.str(), AllOf(HasSubstr("lines about clients were left out"), HasSubstr("is connected")));
}

TEST_F(ConnectionsTest, AFirstRequestOfAWrongSizeIsAnsweredAndCounts) {
  auto client = connect();
  client->send(request('J', 2, 100) + "?");
  EXPECT_EQ(awaitLetter(*client), 'e');
  passFrames(260);
  auto newcomer = connect();
  passFrames(4);
  EXPECT_TRUE(newcomer->ended());
  EXPECT_TRUE(isServed(*client));
}

TEST_F(ConnectionsTest, ClientThatAsksForNothingLosesItsPlaceAfterTwoSeconds) {
  connectServed()->close();  // the one before it has asked for something, and left long ago
  passFrames(1300);
  auto idle = connect();
  passFrames(230);
  auto too_early = connect();
  passFrames(4);
  EXPECT_TRUE(too_early->ended());
  idle->send("P");  // the beginning of a request
  passFrames(30);
  EXPECT_FALSE(idle->ended()) << "nobody else has come";
  auto next = connect();
  EXPECT_TRUE(isServed(*next));
  EXPECT_TRUE(awaitEnd(*idle));
}

class PlayingClientTest : public ConnectionsTest {};

// WAG.MTN takes less than 2 s.
TEST_F(PlayingClientTest, MotionOfASilentVersion1ClientEndsAfterTenSeconds) {
  auto client = connectServed();
  client->send(fileRequest('P', "WAG.MTN", 1000));
  ASSERT_EQ(awaitLetter(*client), 'p');
  passFrames(1250 - 420);
  EXPECT_TRUE(moves("tail_pan"));
  passFrames(20 + 250);
  EXPECT_FALSE(moves("tail_pan"));
  EXPECT_EQ(robot_.joint("tail_pan").position, 0) << "it has ended its repetition";
  EXPECT_TRUE(isServed(*client));
}

}  // namespace
