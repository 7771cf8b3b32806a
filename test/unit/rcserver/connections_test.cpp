// Connections, and clients that are lost.
#include <gmock/gmock.h>

#include <algorithm>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rcserver/ReportLimit.h"
#include "rcserver_fixture.h"

namespace {

using ::testing::HasSubstr;

// The header of a frame that no server takes.
const std::string kTooLarge("Z\0\0\1\0\1\0\1", 8);

class ConnectionsTest : public FakeRobotFixture {
 protected:
  void SetUp() override { start(); }

  // A client that gets a last message before the server closes, and does not close itself.
  std::unique_ptr<TestClient> connectAndBreakTheProtocol() {
    auto client = connect();
    client->send(request('X', 2) + kTooLarge);
    machine_->runPending();
    return client;
  }

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

// ------------------------------------------------------------------------------------------------- closing

// Internet Protocol Version4, 2.7: an orderly close lasts until the other side has closed, too. The server aborts one
// that takes too long.
TEST_F(ConnectionsTest, ClientsThatNeverCloseAreForgottenWithinTwoSeconds) {
  for (size_t i = 0; i < 2; ++i) {
    const auto first = connectAndBreakTheProtocol();
    const auto second = connectAndBreakTheProtocol();
    passFrames(250 + 8);
    auto third = connect();
    EXPECT_TRUE(isServed(*third)) << i;
    const auto fourth = connect();
    passFrames(4);
    EXPECT_EQ(timesSaid("is being served"), i + 1) << "both connections are free again";
    third->close();
    machine_->runPending();
  }
}

TEST_F(ConnectionsTest, LastMessageArrivesThoughTheServerCloses) {
  const auto client = connectAndBreakTheProtocol();
  passFrames(1000);
  EXPECT_TRUE(client->next()) << "the agreement to version 2";
  const std::optional<Frame> last_word = client->nextFrame();
  ASSERT_TRUE(last_word);
  EXPECT_EQ(last_word->header.kind, 'e');
  EXPECT_TRUE(awaitEnd(*client));
}

TEST_F(ConnectionsTest, LastMessageArrivesThoughTheClientReadsLateAndAnotherWasThereLongBefore) {
  connectServed()->close();
  passFrames(200);
  client_ = connect(2048);
  std::string requests = request('X', 2);
  for (int i = 0; i < 100; ++i) {
    requests += frame('V', 0, 7);
  }
  client_->send(requests + kTooLarge);
  machine_->runPending();
  passFrames(4);
  EXPECT_TRUE(await(*client_)) << "the agreement to version 2";
  std::optional<Frame> next = nextFrame();
  while (next && next->header.request_number == 7) {
    next = nextFrame();
  }
  ASSERT_TRUE(next);
  EXPECT_EQ(next->header.kind, 'e');
}

TEST_F(ConnectionsTest, ClientThatIsSlowToCloseIsNotAbortedForTwoSeconds) {
  for (int i = 0; i < 3; ++i) {  // two connections, so that the last one has been closed before
    const auto client = connectAndBreakTheProtocol();
    passFrames(240);
    EXPECT_TRUE(awaitEnd(*client));
    EXPECT_FALSE(client->wasReset()) << i;
    client->close();
    machine_->runPending();
  }
  const auto another = connectAndBreakTheProtocol();
  passFrames(260);
  EXPECT_TRUE(another->wasReset());
}

// The camera delivers an image after the joints have reported a later frame.
TEST_F(ConnectionsTest, ImageOlderThanTheLastJointReadingDropsNoClient) {
  robot_.image_lag = 2;  // it comes a frame after the joints
  connectVersion2();
  for (int i = 0; i < 40; ++i) {
    EXPECT_EQ(answerTo('H', 0).header.kind, 'h');
    passFrames(1);
  }
}

TEST_F(ConnectionsTest, ClientsTurnedAwayThatDoNotCloseDoNotKeepOthersOut) {
  auto served = connectServed();
  std::vector<std::unique_ptr<TestClient>> strangers;
  for (int i = 0; i < 10; ++i) {
    strangers.push_back(connect());
    passFrames(4);
    EXPECT_TRUE(strangers.back()->ended()) << i;
    EXPECT_FALSE(strangers.back()->next());
  }
  served->close();
  machine_->runPending();
  auto next = connect();
  EXPECT_TRUE(isServed(*next));
}

// What it has asked for after that waits, too.
TEST_F(ConnectionsTest, ClientThatClosesWhileTheMemoryStickIsAtWorkLeavesItsPlaceAtOnce) {
  file_keeper_.slowDown();
  const auto impatient = connectServed();
  impatient->send(fileRequest('P', "NOD.MTN", 1));
  machine_->runPending();
  ASSERT_TRUE(file_keeper_.hasJob());
  for (int i = 0; i < 20; ++i) {
    impatient->send(request('S', 1));
    machine_->runPending();
  }
  impatient->close();
  machine_->runPending();
  auto next = connect();
  EXPECT_TRUE(isServed(*next));
}

TEST_F(ConnectionsTest, WhatComesWhileTheMemoryStickIsAtWorkIsAnsweredAfterwards) {
  file_keeper_.slowDown();
  const auto client = connectServed();
  client->send(fileRequest('P', "NOD.MTN", 1));
  constexpr int kRequests = 1000;  // more than fit into the buffer
  for (int i = 0; i < kRequests; ++i) {
    client->send(kRefused);
    machine_->runPending();
  }
  EXPECT_FALSE(client->next());
  file_keeper_.speedUp();
  takeImage();
  for (int i = 0; i < 1 + kRequests; ++i) {
    ASSERT_TRUE(await(*client)) << i;
  }
}

// --------------------------------------------------------------------------------------------------- strangers

// What would switch to version 2 and move a joint, and shut the robot down.
std::string commands() {
  return request('X', 2) + frame('J', 0, 1, std::string("\0\0\1\0\x34\0\0\0\0\x0d\xbb\xa0", 12)) + frame('Q', 0, 2) +
         request('Q', 0, 0);
}

std::string webPage(const std::string& method) {
  return method + " / HTTP/1.1\r\nHost: 127.0.0.1:54321\r\nContent-Type: text/plain\r\n\r\n" + commands();
}

// RFC 5389 and RFC 4571, as Chromium sends it to a "passive" candidate: the user name is the page's choice.
const std::string kStun("\0\x5c\0\1\0\x48\x21\x12\xa4\x42QJFUQAAQRAAR\0\x06\0\x0dQ///:XQQ/WUFU\0\0\0\x24\0\4", 44);

class StrangersTest : public ConnectionsTest {
 protected:
  void SetUp() override { startWith("ALLOW_SHUT_DOWN=yes\nALLOW_REBOOT=yes\nALLOWED_ADDRESSES=any\n"); }

  void expectNothingIsCarriedOut(TestClient& stranger, const std::string& bytes) {
    const std::vector<int> before = positions();
    EXPECT_TRUE(awaitEnd(stranger)) << bytes;
    EXPECT_TRUE(stranger.wasReset()) << bytes;
    EXPECT_EQ(stranger.received(), "") << bytes;
    passFrames(130);
    EXPECT_EQ(positions(), before) << bytes;
    auto client = connectServed();
    EXPECT_FALSE(client->ended()) << bytes;
    client->close();
    machine_->runPending();
  }
};

TEST_F(StrangersTest, AreAbortedBeforeAByteIsHandledAndOthersAreServed) {
  std::vector<std::string> all = {kStun + commands(),
                                  "\x16\x03\x01" + commands(),
                                  "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n",
                                  "??" + commands(),
                                  "q" + commands(),
                                  "H" + commands(),
                                  "\n" + commands()};
  for (const std::string method : {"GET", "POST", "PUT", "HEAD", "OPTIONS", "DELETE", "CONNECT", "TRACE", "PATCH",
                                   "QUERY", "Q", "RR", "SEARCH", "LOCK", "FUFU"}) {
    all.push_back(webPage(method));
  }
  for (const std::string& bytes : all) {
    auto stranger = connect();
    stranger->send(bytes);
    expectNothingIsCarriedOut(*stranger, bytes);
  }
}

// The longest method that a client of the page's could have sent: no byte of it but pictures are asked for.
TEST_F(StrangersTest, AreRecognisedHoweverLongTheirMethodIs) {
  for (const std::string& method :
       {"P" + std::string(3000, 'Q'), "Q" + std::string(3000, 'Q'), std::string(1024, 'R')}) {
    auto stranger = connect();
    stranger->send(webPage(method));
    expectNothingIsCarriedOut(*stranger, method);
  }
}

TEST_F(StrangersTest, AreRecognisedByteByByte) {
  for (const std::string method : {"POST", "DELETE", "QUERY", "PLAY", "RESET", "LOCK", "UPDATE", "KICK", "YES"}) {
    auto stranger = connect();
    for (const char byte : method + " /") {
      EXPECT_EQ(stranger->received(), "") << method;
      stranger->send({byte});
      machine_->runPending();
    }
    expectNothingIsCarriedOut(*stranger, method);
  }
}

TEST_F(StrangersTest, AreCountedOnTheConsoleOnceAMinute) {
  const auto reports_after = [this](int browsers) {
    for (int i = 0; i < browsers; ++i) {
      auto browser = connect();
      browser->send(webPage("POST"));
      EXPECT_TRUE(awaitEnd(*browser));
    }
    return timesSaid("is not a client");
  };
  console_.str("");
  EXPECT_EQ(reports_after(100), 1U);
  const std::string text = console_.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  for (const unsigned reports : {1, 2}) {
    passFrames(58 * 125);
    EXPECT_EQ(reports_after(1), reports);
    passFrames(2 * 125);
    EXPECT_EQ(reports_after(2), reports + 1);
  }
  EXPECT_EQ(timesSaid("101 such connections"), 1U) << "99 in the first second, one before and one after the minute";
  EXPECT_EQ(timesSaid(" 3 such connections"), 1U);
}

TEST_F(ConnectionsTest, ClientsThatComeAndGoAreReportedOnceASecondAfterAFew) {
  for (int i = 0; i < 100; ++i) {
    connectServed()->close();
    machine_->runPending();
  }
  const auto lines = [this] {
    const std::string text = console_.str();
    return static_cast<unsigned>(std::count(text.begin(), text.end(), '\n'));
  };
  EXPECT_GE(timesSaid("is connected"), ReportLimit::BURST / 2 - 1);
  EXPECT_LT(lines(), ReportLimit::BURST + 10);
  console_.str("");
  for (int i = 0; i < 20; ++i) {
    passFrames(100);
    connectServed()->close();
    machine_->runPending();
  }
  EXPECT_THAT(lines(), testing::AllOf(testing::Ge(16U), testing::Lt(16U + 20U))) << "those left out are told, too";
  passFrames(30 * 125);
  console_.str("");
  auto client = connect();
  EXPECT_TRUE(isServed(*client));
  EXPECT_THAT(console_.str(), testing::AllOf(testing::HasSubstr("lines about clients were left out"),
                                             testing::HasSubstr("is connected")));
}

TEST_F(ConnectionsTest, StreamThatIsSwitchedWithoutEndIsReportedOnceASecondAfterAFew) {
  auto client = connectServed();
  console_.str("");
  for (int i = 0; i < 100; ++i) {
    client->send("W\x55");
    machine_->runPending();
  }
  EXPECT_LE(timesSaid("stream o"), ReportLimit::BURST);
  EXPECT_GE(timesSaid("stream o"), ReportLimit::BURST - 3);
}

TEST_F(ConnectionsTest, RequestThatBeginsLikeAMethodIsServedInAnyPieces) {
  const std::string play = "POST.MTN" + std::string(10, '\0');
  for (std::size_t split = 1; split < play.size(); ++split) {
    auto client = connect();
    client->send(play.substr(0, split));
    machine_->runPending();
    client->send(play.substr(split));
    EXPECT_EQ(awaitLetter(*client), 'p') << split << ": the motion is stopped";
    client->close();
    machine_->runPending();
  }
}

// A good request that is refused counts as good, too, as does one that more bytes follow than belong to it.
TEST_F(ConnectionsTest, FirstRequestThatIsRefusedIsAnsweredAndTheClientIsServed) {
  for (const std::string& first : {request('J', 200), request('Q', 0, 0), request('C', 0) + std::string(16, '\0'),
                                   request('V', 'U'), request('J', 1) + request('J', 2) + request('J', 3),
                                   std::string("SBSBSBSB"), request('F', ' '), request('X', 3)}) {
    auto client = connect();
    client->send(first);
    machine_->runPending();
    takeImage();
    EXPECT_TRUE(client->next()) << first;
    EXPECT_TRUE(isServed(*client)) << first;
    client->close();
    machine_->runPending();
  }
}

TEST_F(ConnectionsTest, MethodAfterTheFirstBytesIsAnUnknownRequest) {
  auto client = connectServed();
  client->send("GET / HTTP/1.1\r\n");
  EXPECT_TRUE(await(*client));
  EXPECT_FALSE(client->ended());
}

// ------------------------------------------------------------------------------------------------- silent clients

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

class PlayingClientTest : public ConnectionsTest {
 protected:
  void startPlaying(TestClient& client) {
    client.send(fileRequest('P', "WAG.MTN", 1000));
    ASSERT_EQ(awaitLetter(client), 'p');
    machine_->runPending();
  }

  bool tailMoves() {
    std::vector<int>& path = robot_.joint("tail_pan").path;
    path.clear();
    passFrames(400);
    return std::any_of(path.begin(), path.end(), [&](int position) { return position != path.front(); });
  }
};

// WAG.MTN takes less than 2 s.
TEST_F(PlayingClientTest, MotionOfASilentVersion1ClientEndsAfterTenSecondsButTheClientStays) {
  auto client = connectServed();
  startPlaying(*client);
  passFrames(1250 - 420);
  EXPECT_TRUE(tailMoves());
  EXPECT_EQ(timesSaid("silent for 10 s"), 0U);
  passFrames(20 + 250);
  EXPECT_FALSE(tailMoves());
  passFrames(3000);
  EXPECT_EQ(timesSaid("silent for 10 s: its motions are not repeated any more"), 1U);
  EXPECT_TRUE(isServed(*client));
  startPlaying(*client);
  EXPECT_TRUE(tailMoves());
  passFrames(1250);
  EXPECT_FALSE(tailMoves()) << "it is silent again";
}

TEST_F(PlayingClientTest, MotionOfAVersion1ClientThatReadsItsStreamGoesOn) {
  auto client = connectServed();
  client->send(request('W', 85));
  machine_->runPending();
  client->send(fileRequest('P', "WAG.MTN", 1000));
  for (int i = 0; i < 400; ++i) {
    passFrames(4);
    while (client->next()) {
    }
  }
  EXPECT_TRUE(tailMoves());
}

// What it sends has no answer: the stream ends before its first picture.
TEST_F(PlayingClientTest, MotionOfAVersion1ClientThatOnlySendsGoesOn) {
  auto client = connectServed();
  startPlaying(*client);
  for (int i = 0; i < 4; ++i) {
    passFrames(400);
    client->send(request('W', 85) + request('W', 85));
    machine_->runPending();
  }
  EXPECT_TRUE(tailMoves());
}

// -------------------------------------------------------------------------------------------------------- motors

TEST_F(PlayingClientTest, MotionEndedByTheMotorsDoesNotContinueWhenTheyAreOnAgain) {
  connectVersion2();
  EXPECT_EQ(answerTo('P', 0, std::string("\3\350WAG.MTN")).header.kind, 'p');
  passFrames(200);
  answerTo('O', 0, std::string(1, '\0'));
  live();
  answerTo('O', 0, "\1");
  passFrames(50);
  EXPECT_FALSE(tailMoves());
  live();
  EXPECT_EQ(answerTo('P', 0, std::string("\0\1WAG.MTN", 9)).header.kind, 'p') << "its joints are free";
}

// -------------------------------------------------------------------------------------------- the IPStack refuses

// Parameter: the number of an `Extra` entry in stub.cfg, and the console's message when the IPStack refuses requests
// that it would answer to this entry.
class RefusedByTheIpStackTest : public ConnectionsTest,
                                public ::testing::WithParamInterface<std::pair<size_t, const char*>> {
 protected:
  void SetUp() override {
    refused_entry_ = GetParam().first;
    ConnectionsTest::SetUp();
  }
};

TEST_P(RefusedByTheIpStackTest, ConsoleReportsItAndTheServerGoesOn) {
  const auto client = connect();
  client->send(request('S', 66) + request('?', 0));
  passFrames(130);
  EXPECT_THAT(console_.str(), HasSubstr(GetParam().second));
  passFrames(300);
  EXPECT_THAT(robot_.joint("head_pan").gains.proportional, ::testing::Ne(0)) << "the robot still works";
  EXPECT_LE(timesSaid("no endpoint to listen"), 10U) << "it is tried once a second, with two connections";
}

TEST_F(ConnectionsTest, ListeningThatFailsIsTriedAgainASecondLater) {
  failing_entry_ = 0;
  for (int i = 0; i < 2; ++i) {
    const auto client = connect();
    EXPECT_TRUE(awaitEnd(*client));
  }
  EXPECT_EQ(timesSaid("cannot listen on port 54321 (error "), 2U);
  failing_entry_.reset();
  passFrames(kFramesASecond);
  const auto client = connect();
  EXPECT_TRUE(isServed(*client));
}

INSTANTIATE_TEST_SUITE_P(Entries, RefusedByTheIpStackTest,
                         ::testing::Values(std::make_pair(0, "the IPStack has no endpoint to listen on port 54321"),
                                           std::make_pair(1, "is gone: the IPStack does not send"),
                                           std::make_pair(2, "is gone: the IPStack does not receive")));

}  // namespace
