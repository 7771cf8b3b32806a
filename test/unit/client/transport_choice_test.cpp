// How the client chooses between TCP and UDP.
#include "client/transport_choice.h"
#include "datagrams_fixture.h"

using namespace aibo_client;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

/// A network that may or may not let datagrams through. The robot sends tests when it is asked to.
class TransportChoiceTest : public DatagramsFixture {
 public:
  TransportChoiceTest() {
    wanted_.transport = PictureTransport::kUdp;
    wanted_.streaming = true;
    wanted_.datagram_port = kPort;
  }

  /// Lets time pass. The robot sends its pictures by the transport of the last request.
  void watch(milliseconds time) {
    static const Bytes kJpeg = makeJpeg(1);
    for (const TimePoint end = now_ + time; now_ < end;) {
      const TimePoint image = now_ + milliseconds(32);
      ++picture_;
      if (!by_udp_) {
        receive(version2_frames::makeFrame('f', 0, version2_frames::makePicture(kJpeg, frameOf(picture_))));
      } else if (lets_through_) {
        arrive(makeDatagrams(kJpeg, numberOf(picture_), frameOf(picture_), &sequence_));
      }
      while (now_ < image && !HasFatalFailure()) {
        answerAll();
        pass(std::min(image, session_.nextDeadline()) - now_);
      }
    }
  }

  void answerAll() {
    for (char kind = request(); kind != 0; kind = request()) {
      const Frame asked = frame_;
      if (kind == 'B' && isTest()) {
        ++tests_;
        if (lets_through_) {
          arrive(testDatagram(asked.payload));
        }
      } else if (kind == 'B') {
        by_udp_ = order_.port != 0;
        ways_ += by_udp_ ? "U" : "T";
      }
      answer(asked, kind == 'H' ? version2_frames::makeHello(capabilities_, robotsFrame()) : asked.payload);
    }
  }

  /// Goes on until the robot is asked for a test.
  void beUntilTest() {
    char kind = request();
    while (kind != 'B' && kind != 0) {
      kind = request();
    }
    ASSERT_EQ('B', kind);
  }

  bool lets_through_ = true;
  bool by_udp_ = false;
  int tests_ = 0;
  std::string ways_;  ///< that the robot was told: U, T
};

TEST_F(TransportChoiceTest, WhereNoTestComesNoPictureIsLostAndTheReasonIsTold) {
  lets_through_ = false;
  answerAll();
  watch(milliseconds(700));
  EXPECT_EQ("", connection_.status.transport_problem);
  watch(milliseconds(100));
  EXPECT_THAT(connection_.status.transport_problem, testing::HasSubstr("no test datagram has come; a firewall"));
  watch(seconds(9));
  EXPECT_EQ(4, tests_);
  EXPECT_EQ("", ways_);
  EXPECT_EQ(1, logged("info robot:54321 sends its pictures by TCP, not by UDP"));
  lets_through_ = true;
  watch(seconds(2));
  EXPECT_EQ("U", ways_);
  EXPECT_EQ("", connection_.status.transport_problem);
  EXPECT_EQ(picture_, pictures_.size()) << "the change loses and doubles nothing";
}

TEST_F(TransportChoiceTest, UdpIsUsedAfterOneTestAndTriedAgainAfterDatagramsHaveStopped) {
  answerAll();
  watch(seconds(1));
  EXPECT_EQ("U", ways_);
  EXPECT_EQ(1, tests_);
  lets_through_ = false;
  watch(milliseconds(950));
  EXPECT_EQ("U", ways_);
  watch(milliseconds(550));
  EXPECT_EQ("UT", ways_);
  EXPECT_THAT(connection_.status.transport_problem, testing::HasSubstr("no datagram has come for 1 s"));
  lets_through_ = true;
  watch(seconds(59));
  EXPECT_EQ("UT", ways_);
  watch(seconds(2));
  EXPECT_EQ("UTU", ways_);
}

TEST_F(TransportChoiceTest, OnlyTheRobotsTestCounts) {
  lets_through_ = false;
  beUntilTest();
  const Bytes good = testDatagram(payload_);
  std::vector<Bytes> forged = {Bytes(), Bytes(1372), Bytes(good.begin(), good.end() - 1),
                               makeDatagrams(makeJpeg(1), 0, kFrame, &sequence_)[0]};
  for (const std::size_t number : {7U, 11U}) {  // of the datagram, of the picture
    forged.push_back(good);
    forged.back()[number] ^= 1;
  }
  for (const Bytes& each : forged) {
    arrive(each);
    for (char kind = request(); kind != 0; kind = request()) {
      EXPECT_FALSE(kind == 'B' && !isTest());
    }
  }
  EXPECT_THAT(replies_, testing::IsEmpty());
  arrive(good);
  EXPECT_EQ('B', request());
  EXPECT_FALSE(isTest());
}

// The robot sends by TCP what was not acknowledged when it was told to.
TEST_F(TransportChoiceTest, TheChangeToTcpLosesAndDoublesNoPicture) {
  answerAll();
  watch(seconds(1));
  std::vector<Bytes> cut = nextPicture();
  cut.pop_back();
  arrive(cut);
  wanted_.transport = PictureTransport::kTcp;
  wanted_.datagram_port = 0;
  answerAll();
  EXPECT_EQ("UT", ways_);
  EXPECT_EQ(0, order_.port);
  for (const unsigned picture : {picture_ - 1, picture_, picture_ + 1}) {
    arriveByTcp(picture, frameOf(picture));
  }
  EXPECT_EQ(picture_ + 1, pictures_.size());
  watch(seconds(1));  // the picture that was cut off is not waited for
  EXPECT_EQ("", connection_.status.transport_problem);
}

TEST_F(TransportChoiceTest, AfterAChangeByTheUserUdpIsTriedAtOnce) {
  lets_through_ = false;
  answerAll();
  watch(seconds(2));
  lets_through_ = true;
  wanted_.transport = PictureTransport::kTcp;
  answerAll();
  wanted_.transport = PictureTransport::kUdp;
  watch(milliseconds(64));
  EXPECT_EQ("U", ways_);
}

}  // namespace
