#include "client/version1_session.h"

#include <gmock/gmock.h>

#include <deque>
#include <string>

#include "client/fault.h"
#include "test_pictures.h"

using namespace aibo_driver;
using std::chrono::milliseconds;
using test_pictures::Bytes;
using testing::HasSubstr;

namespace {

/// The robot's end of a session, in stepped time: no sockets, no waiting.
class Version1SessionTest : public testing::Test {
 protected:
  using TimePoint = Session::TimePoint;

  static RcServerClient::Callbacks record(std::vector<PicturePtr>* pictures) {
    RcServerClient::Callbacks callbacks;
    callbacks.on_picture = [pictures](const PicturePtr& picture) { pictures->push_back(picture); };
    return callbacks;
  }

  /// What the session sends now: "" or letter and identifier, as in "W85", and the value that is set, as in "J2=-100".
  std::string command() {
    const Bytes bytes = session_.nextRequest(wish_, now_);
    if (bytes.empty()) {
      return "";
    }
    const std::string command = static_cast<char>(bytes[0]) + std::to_string(bytes[1]);
    return bytes.size() == 2 ? command : command + "=" + std::to_string(protocol::decodeValueReply(bytes.data()).value);
  }

  void receive(const Bytes& bytes) {
    session_.bytesArrived(bytes.data(), bytes.size(), now_);
    session_.foundEmpty(now_);
    session_.checkDeadlines(now_);
  }

  void receivePicture(unsigned number) { receive(test_pictures::makeReply(test_pictures::makeNumbered(number))); }

  /// Lets time pass, with nothing to read, as the client's loop does.
  void pass(milliseconds time) {
    const TimePoint end = now_ + time;
    while (now_ < end) {
      const TimePoint next = std::min(end, session_.nextDeadline());
      ASSERT_GT(next, now_) << "the loop would spin";
      now_ = next;
      session_.foundEmpty(now_);
      session_.checkDeadlines(now_);
    }
  }

  std::future<PictureAnswer> takePicture(int quality, milliseconds timeout = milliseconds(2000)) {
    PictureRequest request;
    request.quality = quality;
    request.timeout = timeout;
    request.deadline = now_ + timeout;
    auto answer = request.promise.get_future();
    session_.add(std::move(request), now_);
    return answer;
  }

  static bool done(const std::future<PictureAnswer>& answer) {
    return answer.wait_for(milliseconds(0)) == std::future_status::ready;
  }

  std::vector<PicturePtr> pictures_;
  Notifier notifier_{record(&pictures_)};
  Counters counters_;
  Wish wish_{false, 85, 0};
  TimePoint now_ = TimePoint() + milliseconds(100000);
  ServerHabits habits_;
  Version1Session session_{{"robot:54321", milliseconds(500), notifier_, counters_},
                           habits_,
                           Version1Session::VersionAnswer::kNotAsked,
                           now_};
};

TEST_F(Version1SessionTest, AConnectionOnWhichNothingIsWantedStaysSilentForEver) {
  EXPECT_EQ("", command());
  pass(milliseconds(3600 * 1000));
  EXPECT_EQ("", command());
  EXPECT_TRUE(session_.settled());
}

TEST_F(Version1SessionTest, TheStreamIsToggledOnceForEachChangeOfWish) {
  wish_.streaming = true;
  EXPECT_EQ("W85", command());
  EXPECT_EQ("", command());
  receivePicture(1);
  EXPECT_EQ("", command());
  wish_.streaming = false;
  EXPECT_EQ("W85", command());
  EXPECT_EQ("", command());
}

TEST_F(Version1SessionTest, RapidTogglesNeverLoseTheParity) {
  int toggles = 0;
  for (int i = 0; i < 1000; ++i) {
    wish_.streaming = i % 3 != 0;
    toggles += command().empty() ? 0 : 1;
    EXPECT_EQ(wish_.streaming, toggles % 2 == 1);
    EXPECT_EQ(wish_.streaming, session_.streaming());
  }
}

TEST_F(Version1SessionTest, EveryPictureOfTheStreamIsDeliveredAlsoTwoInOneRead) {
  wish_.streaming = true;
  command();
  Bytes two = test_pictures::makeReply(test_pictures::makeNumbered(1));
  const Bytes second = test_pictures::makeReply(test_pictures::makeNumbered(2));
  two.insert(two.end(), second.begin(), second.end());
  receive(two);
  ASSERT_EQ(2u, pictures_.size());
  EXPECT_EQ(test_pictures::makeNumbered(2), pictures_[1]->jpeg);
  EXPECT_EQ(208, pictures_[1]->width);
  EXPECT_EQ(160, pictures_[1]->height);
  EXPECT_EQ(0u, counters_.stale_pictures);
}

TEST_F(Version1SessionTest, AStreamThatIsSilentIsGivenUpAtTheLimit) {
  wish_.streaming = true;
  command();
  receivePicture(1);
  pass(milliseconds(499));
  EXPECT_THROW(pass(milliseconds(1)), Fault);
}

TEST_F(Version1SessionTest, AHalfReceivedPictureIsGivenUpAtTheLimit) {
  receive({'f', 0, 0});
  pass(milliseconds(499));
  EXPECT_THROW(pass(milliseconds(1)), Fault);
}

TEST_F(Version1SessionTest, ASlowPictureIsNotGivenUpWhileItsBytesCome) {
  wish_.streaming = true;
  command();
  const Bytes reply = test_pictures::makeReply(test_pictures::makeNumbered(1));
  for (std::size_t i = 0; i < 20; ++i) {
    pass(milliseconds(400));
    receive({reply[i]});
  }
  receive(Bytes(reply.begin() + 20, reply.end()));
  EXPECT_EQ(1u, pictures_.size());
}

TEST_F(Version1SessionTest, AfterAStallOnlyFreshPicturesAreDelivered) {
  wish_.streaming = true;
  command();
  now_ += milliseconds(30);
  receivePicture(1);
  now_ += milliseconds(5000);  // this process was stopped for 5 s; the robot's pictures have waited
  receivePicture(2);
  now_ += milliseconds(3);
  receivePicture(3);
  pass(milliseconds(25));
  receivePicture(4);
  ASSERT_EQ(2u, pictures_.size());
  EXPECT_EQ(test_pictures::makeNumbered(1), pictures_[0]->jpeg);
  EXPECT_EQ(test_pictures::makeNumbered(4), pictures_[1]->jpeg);
  EXPECT_EQ(2u, counters_.stale_pictures);
  EXPECT_EQ(2u, counters_.pictures);
}

TEST_F(Version1SessionTest, PicturesOfAStoppedStreamAreDroppedAndCounted) {
  wish_.streaming = true;
  command();
  receivePicture(1);
  wish_.streaming = false;
  command();
  receivePicture(2);
  pass(milliseconds(33));
  receivePicture(3);
  EXPECT_EQ(1u, pictures_.size());
  EXPECT_EQ(2u, counters_.unexpected_pictures);
}

TEST_F(Version1SessionTest, AServerThatDoesNotStopIsGivenUp) {
  wish_.streaming = true;
  command();
  wish_.streaming = false;
  command();
  std::string why;
  int late = 0;
  for (; why.empty() && late < 100; ++late) {
    pass(milliseconds(33));
    try {
      receivePicture(1);
    } catch (const Fault& fault) {
      why = fault.what();
    }
  }
  EXPECT_THAT(why, HasSubstr("it goes on sending pictures although it was told to stop"));
  EXPECT_NEAR(31, late, 2);
}

TEST_F(Version1SessionTest, WithoutAStreamAPictureIsRequestedOnceWithItsQuality) {
  auto answer = takePicture(40);
  EXPECT_EQ("F40", command());
  EXPECT_EQ("", command());
  receivePicture(1);
  ASSERT_TRUE(done(answer));
  const PictureAnswer got = answer.get();
  EXPECT_EQ(test_pictures::makeNumbered(1), got.picture->jpeg);
  EXPECT_FALSE(got.from_stream);
  EXPECT_EQ(1u, pictures_.size()) << "it is published like any other";
  EXPECT_EQ("", command());
}

TEST_F(Version1SessionTest, QualityZeroIsThatOfTheStream) {
  auto answer = takePicture(0);
  EXPECT_EQ("F85", command());
}

TEST_F(Version1SessionTest, SeveralCallersGetAPictureEachOfTheirOwnQuality) {
  auto first = takePicture(10);
  auto second = takePicture(20);
  EXPECT_EQ("F10", command());
  EXPECT_EQ("", command());
  receivePicture(1);
  EXPECT_TRUE(done(first));
  EXPECT_FALSE(done(second));
  EXPECT_EQ("F20", command());
  receivePicture(2);
  EXPECT_EQ(test_pictures::makeNumbered(2), second.get().picture->jpeg);
}

TEST_F(Version1SessionTest, DuringTheStreamEveryCallerGetsTheNextPictureThatBeginsAfterTheCall) {
  wish_.streaming = true;
  command();
  const Bytes reply = test_pictures::makeReply(test_pictures::makeNumbered(1));
  receive(Bytes(reply.begin(), reply.begin() + 100));
  pass(milliseconds(1));
  auto first = takePicture(10);
  auto second = takePicture(20);
  pass(milliseconds(1));
  receive(Bytes(reply.begin() + 100, reply.end()));
  EXPECT_FALSE(done(first)) << "this one had begun before the call";
  EXPECT_EQ("", command()) << "no F into the own stream";
  pass(milliseconds(32));
  receivePicture(2);
  ASSERT_TRUE(done(first));
  ASSERT_TRUE(done(second));
  const PictureAnswer got = first.get();
  EXPECT_TRUE(got.from_stream);
  EXPECT_EQ(test_pictures::makeNumbered(2), got.picture->jpeg);
  EXPECT_EQ(got.picture, second.get().picture);
}

TEST_F(Version1SessionTest, AfterAStopTheRequestWaitsUntilTheStreamHasDrained) {
  wish_.streaming = true;
  command();
  receivePicture(1);
  wish_.streaming = false;
  command();
  auto answer = takePicture(30);
  EXPECT_EQ("", command());
  pass(milliseconds(150));
  receivePicture(2);
  pass(milliseconds(199));
  EXPECT_EQ("", command());
  EXPECT_FALSE(done(answer)) << "a late picture of the stream is not fresh";
  pass(milliseconds(1));
  EXPECT_EQ("F30", command());
  receivePicture(3);
  EXPECT_EQ(test_pictures::makeNumbered(3), answer.get().picture->jpeg);
}

TEST_F(Version1SessionTest, TheStreamIsNotToggledWhileAPictureIsOwed) {
  auto answer = takePicture(30);
  EXPECT_EQ("F30", command());
  wish_.streaming = true;
  EXPECT_EQ("", command());
  receivePicture(1);
  EXPECT_FALSE(answer.get().from_stream);
  EXPECT_EQ("W85", command());
}

TEST_F(Version1SessionTest, AnOwedPictureThatDoesNotComeEndsTheCallAndTheConnection) {
  auto answer = takePicture(30, milliseconds(300));
  command();
  EXPECT_THROW(pass(milliseconds(300)), Fault);
  EXPECT_EQ(CallOutcome::kTimeout, answer.get().outcome);
}

TEST_F(Version1SessionTest, ACallThatTimesOutBeforeItsRequestWasSentLeavesTheConnectionAlone) {
  auto first = takePicture(30, milliseconds(400));
  auto second = takePicture(40, milliseconds(100));
  command();
  pass(milliseconds(150));
  EXPECT_EQ(CallOutcome::kTimeout, second.get().outcome);
  receivePicture(1);
  EXPECT_TRUE(done(first));
  EXPECT_EQ("", command());
}

TEST_F(Version1SessionTest, ARefusedPictureEndsTheCallWithTheRobotsCode) {
  auto answer = takePicture(30);
  command();
  receive({'e', 0, 1, 0});
  const PictureAnswer refusal = answer.get();
  EXPECT_EQ(CallOutcome::kRefused, refusal.outcome);
  EXPECT_EQ("robot:54321 refused to take a picture: error code 1.", refusal.problem);
  pass(milliseconds(5000));
}

TEST_F(Version1SessionTest, ARefusedStreamEndsTheConnectionWithTheRobotsCode) {
  wish_.streaming = true;
  command();
  EXPECT_THROW(receive({'e', 0, 0, 0}), Fault);
}

TEST_F(Version1SessionTest, ADamagedAnswerIsRequestedAgainWhileTheTimeAllows) {
  auto answer = takePicture(30);
  command();
  receive(test_pictures::makeReply(Bytes(5000, 0)));
  EXPECT_EQ("F30", command());
  receivePicture(2);
  EXPECT_EQ(test_pictures::makeNumbered(2), answer.get().picture->jpeg);
  EXPECT_EQ(1u, counters_.corrupt_pictures);
}

TEST_F(Version1SessionTest, ACallThatGotOnlyDamagedPicturesSaysSo) {
  auto answer = takePicture(30, milliseconds(200));
  const auto send_damaged_pictures = [this] {
    for (int i = 0; i < 10; ++i) {
      command();
      pass(milliseconds(33));
      receive(test_pictures::makeReply(Bytes(5000, 0)));
    }
  };
  EXPECT_THROW(send_damaged_pictures(), Fault);
  EXPECT_THAT(answer.get().problem, HasSubstr("no picture within 200 ms; the last one was damaged: not a JPEG"));
}

TEST_F(Version1SessionTest, DamagedPicturesOfTheStreamAreDroppedAndTheStreamGoesOn) {
  wish_.streaming = true;
  command();
  Bytes damaged = test_pictures::makeNumbered(1);
  damaged.resize(damaged.size() / 2);
  receive(test_pictures::makeReply(damaged));
  receivePicture(2);
  ASSERT_EQ(1u, pictures_.size());
  EXPECT_EQ(1u, counters_.corrupt_pictures);
  EXPECT_EQ(1u, counters_.pictures);
}

}  // namespace
