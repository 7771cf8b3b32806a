// Clients that come back before the robot knows that they were gone.
#include <gmock/gmock.h>

#include <memory>
#include <set>
#include <string>

#include "protocol/hello.h"
#include "protocol/introduction.h"
#include "rcserver/TokenMaker.h"
#include "rcserver_fixture.h"

namespace {

using namespace protocol::version2;
using ::testing::HasSubstr;
using ::testing::Not;

std::string introduce(const std::string& token) {
  std::string bytes(INTRODUCTION_SIZE, '\0');
  encodeIntroduction(token.c_str(), reinterpret_cast<unsigned char*>(bytes.data()));
  return bytes;
}

class TokenTest : public FakeRobotFixture {
 protected:
  void SetUp() override {
    start();
    connectVersion2();
  }

  std::string token() {
    const Frame answer = answerTo('H', 0);
    Hello hello{};
    EXPECT_EQ(decodeHello(answer.payload.data(), answer.payload.size(), &hello), nullptr);
    return hello.token;
  }

  // Connects beside the client that is served.
  std::unique_ptr<TestClient> comeWith(const std::string& bytes) {
    auto newcomer = connect();
    newcomer->send(bytes);
    machine_->runPending();
    return newcomer;
  }

  bool isTurnedAway(TestClient& client) { return client.ended() && client.wasReset() && client.received().empty(); }
};

TEST_F(TokenTest, ClientWithItsTokenTakesItsPlaceAtOnceAndIsGreeted) {
  answerTo('W', 85, kStreamOn);
  auto back = comeWith(introduce(token()));
  EXPECT_TRUE(client_->wasReset()) << "the old connection: nobody would answer an orderly close";
  const std::vector<uint8_t> reply = back->take(protocol::VALUE_REPLY_SIZE);
  ASSERT_EQ(reply.size(), protocol::VALUE_REPLY_SIZE);
  EXPECT_TRUE(agreesToVersion2(protocol::decodeValueReply(reply.data())));
  const auto hello = back->nextFrame();
  ASSERT_TRUE(hello);
  EXPECT_EQ(hello->header.kind, 'h');
  EXPECT_EQ(hello->header.request_number, INTRODUCTION_NUMBER);
  takeImage();
  EXPECT_FALSE(back->nextFrame()) << "the stream was the old connection's";
  client_ = std::move(back);
  EXPECT_EQ(answerTo('H', 0).header.kind, 'h');
  EXPECT_THAT(console_.str(), HasSubstr("it has come back over a new connection"));
}

TEST_F(TokenTest, EachConnectionHasAnotherTokenAndKeepsIt) {
  std::set<std::string> tokens;
  for (int i = 0; i < 50; ++i) {
    const std::string given = token();
    EXPECT_TRUE(isToken(given.c_str())) << given;
    EXPECT_EQ(token(), given);
    EXPECT_TRUE(tokens.insert(given).second) << given;
    reconnect();
  }
}

TEST_F(TokenTest, TokensOfTwoRobotsDiffer) {
  const std::string first = token();
  host_.random[0] = 1;  // the simulator's
  start();
  connectVersion2();
  EXPECT_NE(token(), first);
}

// Of two robots that are alike in all else, such as two that are switched on together.
TEST(TokenMakerTest, ThePixelsOfAnImageMakeTheDifference) {
  std::set<std::string> tokens;
  for (const bool is_noisy : {false, true}) {
    FakeRobot robot;
    if (is_noisy) {
      robot.showNoise();
    }
    TokenMaker maker;
    void* const image = robot.captureImage(1)->Base();
    maker.Stir(static_cast<OFbkImageVectorData*>(image));
    char token[TOKEN_SIZE + 1];
    maker.Make(token);
    EXPECT_TRUE(tokens.insert(token).second);
  }
}

TEST_F(TokenTest, OthersAreTurnedAwayAtOnceWithoutAnAnswer) {
  const std::string given = token();
  std::string wrong = given;
  wrong[15] = wrong[15] == '0' ? '1' : '0';
  for (const std::string& bytes : {introduce(wrong), introduce("0000000000000000"), request('X', 2),
                                   std::string("F\x55"), introduce(given).substr(0, INTRODUCTION_SIZE - 1),
                                   std::string("GET / HTTP/1.1\r\n\r\n"), std::string(1, 'X')}) {
    auto stranger = comeWith(bytes);
    EXPECT_TRUE(isTurnedAway(*stranger)) << bytes;
    EXPECT_EQ(answerTo('H', 0).header.kind, 'h') << "the client is served on";
  }
}

TEST_F(TokenTest, TokenOfAnEarlierConnectionIsWorthNothing) {
  const std::string old = token();
  reconnect();
  token();
  auto late = comeWith(introduce(old));
  EXPECT_TRUE(isTurnedAway(*late));
  EXPECT_EQ(answerTo('H', 0).header.kind, 'h');
}

TEST_F(TokenTest, NewcomerThatIsSilentIsTurnedAwayAfterHalfASecond) {
  token();
  passFrames(100);
  auto silent = comeWith("");
  passFrames(50);
  EXPECT_FALSE(silent->ended());
  passFrames(20);
  EXPECT_TRUE(isTurnedAway(*silent));
  EXPECT_EQ(answerTo('H', 0).header.kind, 'h');
}

TEST_F(TokenTest, NewcomerIsTurnedAwayAtOnceIfTheClientHasNoToken) {
  auto second = connect();
  EXPECT_TRUE(isTurnedAway(*second)) << "the client has not been greeted";
  token();
  reconnect();
  auto third = connect();
  EXPECT_TRUE(isTurnedAway(*third)) << "the token was that of another connection";
}

TEST_F(TokenTest, NewcomerFromAnotherAddressIsTurnedAwayAtOnce) {
  token();
  auto other = connect(0, "127.0.0.2");
  EXPECT_TRUE(isTurnedAway(*other));
}

TEST_F(TokenTest, NobodyGetsThePlaceOfAClientThatGoesBecauseTheRobotGoesOff) {
  token();
  auto next = comeWith("");
  robot_.power_status.robotStatus |= orsbBATTERY_CAPACITY_LOW;
  passFrames(1);
  EXPECT_TRUE(client_->ended());
  passFrames(kUntilMeasured);
  EXPECT_TRUE(isTurnedAway(*next));
}

TEST_F(TokenTest, ClientDoesNotComeBackToARobotThatGoesOff) {
  disconnect();
  connectVersion2(4096);
  const std::string given = token();
  auto back = comeWith("");
  stallBehind("");
  robot_.power_status.robotStatus |= orsbBATTERY_CAPACITY_LOW;
  passFrames(1);
  ASSERT_FALSE(client_->isAtEnd()) << "it has not been told yet";
  back->send(introduce(given));
  machine_->runPending();
  EXPECT_TRUE(isTurnedAway(*back));
}

TEST_F(TokenTest, NewcomerThatWaitsGetsThePlaceOfAClientThatGoes) {
  token();
  auto next = comeWith("");
  disconnect();
  passFrames(4);
  next->send("??");
  machine_->runPending();
  EXPECT_TRUE(next->next());
}

TEST_F(TokenTest, NewcomerThatGoesAgainLeavesItsPlace) {
  token();
  for (int i = 0; i < 5; ++i) {
    auto visitor = comeWith("");
    visitor->close();
    machine_->runPending();
  }
  auto back = comeWith(introduce(token()));
  EXPECT_FALSE(back->received().empty());
}

TEST_F(TokenTest, IntroductionToARobotThatServesNobodyIsAnOrdinaryBeginning) {
  const std::string given = token();
  disconnect();
  auto back = comeWith(introduce(given));
  EXPECT_EQ(back->take(protocol::VALUE_REPLY_SIZE).size(), protocol::VALUE_REPLY_SIZE);
  EXPECT_TRUE(back->nextFrame());
}

TEST_F(TokenTest, ConsoleNeverShowsAToken) {
  const std::string given = token();
  auto back = comeWith(introduce(given));
  auto stranger = comeWith(introduce("0123456789abcdef"));
  passFrames(200);
  EXPECT_THAT(console_.str(), Not(HasSubstr(given)));
  EXPECT_THAT(console_.str(), Not(HasSubstr("0123456789abcdef")));
}

}  // namespace
