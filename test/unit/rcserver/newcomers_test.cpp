// Newcomers while a client is served: others, strangers, and the client itself, which comes back before the robot knows
// that its old connection is dead.

#include "rcserver_fixture.h"

namespace {

using ::testing::Gt;
using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr unsigned kSign = 38;  // frames: 0.3 s

class NewcomersTest : public Version2Fixture {
 protected:
  // Connects beside the client that is served.
  std::unique_ptr<TestClient> comeWith(const std::string& bytes, const char* from = "127.0.0.1") {
    auto newcomer = connect(0, from);
    newcomer->send(bytes);
    machine_->runPending();
    return newcomer;
  }

  bool isTurnedAway(TestClient& client) { return client.ended() && client.wasReset() && client.received().empty(); }

  bool isTurnedAwayWithinAFewFrames(TestClient& client) {
    passFrames(4);
    return isTurnedAway(client);
  }

  // The client is asked for a sign.
  bool isAsked() {
    const std::optional<Frame> next = frameThatIsHere();
    return next && next->header.kind == 'h' && next->header.request_number == 0 && next->payload.empty();
  }

  bool isAgreedToVersion2(TestClient& client) {
    const std::optional<Reply> reply = client.next();
    return reply && protocol::version2::agreesToVersion2(reply->value);
  }
};

TEST_F(NewcomersTest, TakeThePlaceOfASilentClientAtTheirAddressAfter300Ms) {
  answerTo('W', 85, kStreamOn);
  auto back = comeWith(request('X', 2));
  EXPECT_TRUE(isAsked());
  passFrames(kSign - 2);
  EXPECT_FALSE(client_->ended());
  passFrames(6);
  EXPECT_FALSE(isAsked()) << "it is asked once";
  EXPECT_TRUE(client_->wasReset()) << "the old connection: nobody would answer an orderly close";
  EXPECT_TRUE(isAgreedToVersion2(*back));
  takeImage();
  client_ = std::move(back);
  EXPECT_FALSE(frameThatIsHere()) << "the stream was the old connection's";
  EXPECT_EQ(answerTo('H', 0).header.kind, 'h');
  EXPECT_THAT(console_.str(), HasSubstr("it has come back over a new connection"));
}

TEST_F(NewcomersTest, AreTurnedAwayWithinAFewFramesAfterASignOfTheClient) {
  passFrames(500);  // of silence
  for (const std::string& bytes : {request('X', 2), std::string("F\x55")}) {
    auto other = comeWith(bytes);
    EXPECT_TRUE(isAsked());
    passFrames(kSign - 8);
    EXPECT_FALSE(other->ended());
    EXPECT_EQ(answerTo('H', 0).header.kind, 'h') << "the client is served on";
    EXPECT_TRUE(isTurnedAwayWithinAFewFrames(*other)) << bytes;
  }
}

TEST_F(NewcomersTest, TakeNoPlaceWhileALargePictureDelaysTheQuestionForASign) {
  connectBehindAPicture();
  auto other = comeWith(request('X', 2));
  unsigned passed = 0;
  for (; arrived('h').empty() && passed < 500; passed += 20) {
    passFrames(20);  // it takes a part of the picture each time
  }
  EXPECT_GT(passed, 2 * kSign);
  EXPECT_EQ(answerTo('H', 0).header.kind, 'h');
  EXPECT_TRUE(isTurnedAwayWithinAFewFrames(*other));
}

TEST_F(NewcomersTest, TakeThePlaceOfAClientThatTakesNothingOfALargePictureAnyMore) {
  connectBehindAPicture();
  passFrames(100);
  auto back = comeWith(request('X', 2));
  passFrames(kSign + 4);
  EXPECT_TRUE(isAgreedToVersion2(*back));
}

// What an outage leaves behind: the IPStack still takes what the client cannot get.
TEST_F(NewcomersTest, TakeThePlaceOfAClientWhoseIPStackTakesTelemetryForIt) {
  answerTo('T', 0, payloadOf(protocol::version2::TelemetryPeriod{4}));
  passFrames(4);
  auto back = comeWith(request('X', 2));
  passFrames(kSign + 4);
  EXPECT_THAT(arrived('t'), SizeIs(Gt(6)));
  EXPECT_TRUE(isAgreedToVersion2(*back));
}

TEST_F(NewcomersTest, FromAnotherAddressWaitUntilTheClientIsFoundDead) {
  machine_.reset();
  startWith("ALLOWED_ADDRESSES=any\n");
  connectVersion2();
  auto other = comeWith(request('X', 2), "127.0.0.2");
  EXPECT_TRUE(isTurnedAwayWithinAFewFrames(*other));
  EXPECT_FALSE(isAsked());
  passFrames(625);
  auto next = comeWith(request('X', 2), "127.0.0.2");
  EXPECT_TRUE(isAgreedToVersion2(*next));
}

// A web page's connection would end the one of a client in an outage.
TEST_F(NewcomersTest, ThatAreStrangersTakeNoPlace) {
  for (const std::string& bytes : {std::string("GET / HTTP/1.1\r\n\r\n"), std::string("POST / HTTP/1.1\r\n\r\nX\2"),
                                   std::string("\0\x80\0\1", 4), std::string("QUERY /"), std::string("\x16\3\1")}) {
    auto stranger = comeWith(bytes);
    EXPECT_TRUE(isTurnedAway(*stranger)) << bytes;
  }
  auto incomplete = comeWith("X");
  passFrames(50);
  EXPECT_FALSE(isAsked());
  EXPECT_EQ(answerTo('H', 0).header.kind, 'h') << "the client is served on";
}

TEST_F(NewcomersTest, ThatAreSilentAreTurnedAwayAfterHalfASecond) {
  auto silent = comeWith("");
  passFrames(50);
  EXPECT_FALSE(silent->ended());
  passFrames(20);
  EXPECT_TRUE(isTurnedAway(*silent));
  EXPECT_EQ(answerTo('H', 0).header.kind, 'h');
}

}  // namespace
