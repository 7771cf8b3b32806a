// Pictures by UDP from a robot that repeats lost parts: what the client asks for, and in which order it delivers.
#include <gmock/gmock.h>

#include <vector>

#include "datagrams_fixture.h"

using namespace aibo_client;
using std::chrono::milliseconds;
using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

namespace {

using Status = protocol::version2::DatagramStatus;

class RepeatedDatagramsTest : public DatagramsFixture {
 public:
  RepeatedDatagramsTest() : DatagramsFixture("F W B X") {
    wish_.transport = PictureTransport::kUdp;
    startStream();
  }

  /// The statuses that were sent since the last call.
  std::vector<Status> takeStatuses() {
    std::vector<Status> statuses;
    for (const Bytes& reply : std::exchange(replies_, {})) {
      Status status = {};
      if (decode(reply.data(), reply.size(), &status) == nullptr) {
        statuses.push_back(status);
      }
    }
    return statuses;
  }

  /// The parts of a picture that were asked for since the last call.
  std::vector<unsigned> takeRequests(unsigned picture) {
    std::vector<unsigned> parts;
    for (const Status& status : takeStatuses()) {
      for (unsigned bit = 0; bit < Status::MOST_MISSING && status.picture == numberOf(picture); ++bit) {
        if ((status.missing >> bit & 1) != 0) {
          parts.push_back(status.first_part + bit);
        }
      }
    }
    return parts;
  }

  /// The robot repeats a part of the last picture.
  Bytes repeated(Bytes datagram) {
    for (int i = 0; i < 4; ++i) {
      datagram[static_cast<std::size_t>(4 + i)] = static_cast<std::uint8_t>(sequence_ >> (24 - 8 * i));
    }
    ++sequence_;
    return datagram;
  }

  /// Lets time pass while TCP works and no datagram comes.
  void wait(milliseconds time) {
    for (const TimePoint end = now_ + time; now_ < end && !HasFatalFailure();) {
      answer();
      pass(std::min(end, session_.nextDeadline()) - now_);
    }
  }

  void arriveEach(milliseconds interval, const std::vector<Bytes>& datagrams) {
    for (const Bytes& datagram : datagrams) {
      wait(interval);
      arrive(datagram);
    }
  }

  /// Lets parts and pictures come at these intervals, so that the pace is known.
  void knowPace(milliseconds part, milliseconds picture) {
    for (int i = 0; i < 40; ++i) {
      const TimePoint next = now_ + picture;
      arriveEach(part, nextPicture());
      wait(std::chrono::round<milliseconds>(next - now_));
    }
    replies_.clear();
    pictures_.clear();
  }
};

bool operator==(const Status& a, const Status& b) {
  return a.first_part == b.first_part && a.picture == b.picture && a.missing == b.missing;
}

TEST_F(RepeatedDatagramsTest, EachWholePictureIsReportedAtOnce) {
  for (unsigned picture = 1; picture < 4; ++picture) {
    arrive(nextPicture());
    const std::vector<Status> statuses = takeStatuses();
    ASSERT_EQ(1u, statuses.size());
    EXPECT_TRUE(statuses[0] == (Status{0, numberOf(picture + 1), 0}));
  }
  EXPECT_THAT(delivered(), ElementsAre(1, 2, 3));
}

TEST_F(RepeatedDatagramsTest, APartIsAskedForOnceWhenALaterOneShowsThatItIsLost) {
  const std::vector<Bytes> picture = nextPicture();
  arrive(picture[0]);
  EXPECT_THAT(takeRequests(1), IsEmpty());
  arrive(picture[2]);
  EXPECT_THAT(takeRequests(1), ElementsAre(1u));
  for (std::size_t part = 3; part < picture.size(); ++part) {
    arrive(picture[part]);
  }
  EXPECT_THAT(takeRequests(1), IsEmpty());
  EXPECT_THAT(delivered(), IsEmpty());
  arrive(repeated(picture[1]));
  EXPECT_THAT(delivered(), ElementsAre(1));
  EXPECT_EQ(0u, counters_.lost_pictures);
}

TEST_F(RepeatedDatagramsTest, TheLastPartIsAskedForWhenNothingComes) {
  knowPace(milliseconds(2), milliseconds(32));
  std::vector<Bytes> picture = nextPicture();
  const Bytes last = picture.back();
  picture.pop_back();
  arrive(picture);
  wait(milliseconds(7));
  EXPECT_THAT(takeRequests(picture_), IsEmpty()) << "it may still be on its way";
  wait(milliseconds(1));
  EXPECT_THAT(takeRequests(picture_), ElementsAre(picture.size()));
  arrive(repeated(last));
  EXPECT_THAT(delivered(), ElementsAre(picture_));
}

TEST_F(RepeatedDatagramsTest, WhileTheSpeedOfTheLinkIsUnknownAPartHasMoreTime) {
  arrive(nextPicture()[0]);
  wait(milliseconds(49));
  EXPECT_THAT(takeRequests(1), IsEmpty());
  wait(milliseconds(1));
  EXPECT_THAT(takeRequests(1), Not(IsEmpty()));
}

TEST_F(RepeatedDatagramsTest, APictureThatWasLostWholeIsAskedFor) {
  arrive(nextPicture());
  const std::vector<Bytes> lost = nextPicture();
  takeStatuses();
  arrive(nextPicture());
  const std::vector<Status> statuses = takeStatuses();
  ASSERT_FALSE(statuses.empty());
  EXPECT_TRUE(statuses[0] == (Status{0, numberOf(2), ~0U})) << "the client does not know how many parts it has";
  EXPECT_THAT(delivered(), ElementsAre(1)) << "the third waits";
  for (const Bytes& datagram : lost) {
    arrive(repeated(datagram));
  }
  EXPECT_THAT(delivered(), ElementsAre(1, 2, 3));
}

TEST_F(RepeatedDatagramsTest, AWholePictureDoesNotWaitForLong) {
  arrive(nextCut());
  const std::vector<Bytes> whole = nextPicture(true);
  arrive(whole);
  wait(milliseconds(1));
  arrive({repeated(whole.front()), repeated(whole.back())});  // it has this part and this parity already
  wait(milliseconds(28));
  EXPECT_THAT(delivered(), IsEmpty());
  wait(milliseconds(1));
  EXPECT_THAT(delivered(), ElementsAre(2));
  EXPECT_EQ(1u, counters_.lost_pictures);
  arrive(nextPicture());
  EXPECT_THAT(delivered(), ElementsAre(2, 3)) << "the next one need not wait";
}

TEST_F(RepeatedDatagramsTest, APictureThatTheRobotNoLongerHasIsGivenUpAtOnce) {
  arrive(nextCut());
  arrive(nextPicture());
  arrive(nextPicture());
  EXPECT_THAT(delivered(), IsEmpty());
  arrive(nextPicture()[0]);  // the robot keeps three pictures
  EXPECT_THAT(delivered(), ElementsAre(2, 3));
}

TEST_F(RepeatedDatagramsTest, AfterAnOutageNoPictureWaitsForThoseBeforeIt) {
  knowPace(milliseconds(2), milliseconds(32));
  arrive(nextPicture()[0]);
  nextPicture();
  wait(milliseconds(700));
  takeStatuses();
  const unsigned first = picture_ + 1;
  arrive(nextPicture());
  EXPECT_THAT(delivered(), ElementsAre(first));
  EXPECT_THAT(takeRequests(first - 1), IsEmpty());
}

TEST_F(RepeatedDatagramsTest, IfNothingComesTheRobotIsAskedAgainAtGrowingIntervals) {
  knowPace(milliseconds(2), milliseconds(32));
  std::vector<Bytes> picture = nextPicture();
  picture.pop_back();
  arrive(picture);
  for (const char* const time : {"the first time", "after another datagram"}) {
    std::vector<long> times;
    for (int ms = 1; ms <= 400; ++ms) {
      wait(milliseconds(1));
      if (!takeStatuses().empty()) {
        times.push_back(ms);
      }
    }
    EXPECT_THAT(times, ElementsAre(8, 8 + 16, 8 + 16 + 32, 8 + 16 + 32 + 64)) << time;
    arrive(repeated(picture[0]));
  }
}

TEST_F(RepeatedDatagramsTest, TheStatusOfAWholePictureIsRepeatedBecauseTheRobotWaitsForIt) {
  arrive(nextPicture());
  takeStatuses();
  wait(milliseconds(49));
  EXPECT_THAT(takeStatuses(), IsEmpty());
  wait(milliseconds(1));
  EXPECT_EQ(1u, takeStatuses().size());
}

TEST_F(RepeatedDatagramsTest, WhereParitiesComeAPartIsAskedForOnlyIfTheyDoNotHelp) {
  arrive(nextPicture(true));
  std::vector<Bytes> picture = nextPicture(true);
  const Bytes one = picture[0];
  takeStatuses();
  picture.erase(picture.begin());
  arrive(picture);
  EXPECT_THAT(takeRequests(2), IsEmpty());
  EXPECT_THAT(delivered(), ElementsAre(1, 2));
  picture = nextPicture(true);
  arrive(picture[0]);
  arrive(picture[3]);  // two are missing, one parity will come
  EXPECT_THAT(takeRequests(3), ElementsAre(1u, 2u));
}

TEST_F(RepeatedDatagramsTest, ALostParityIsNotWaitedFor) {
  arrive(nextPicture(true));
  std::vector<Bytes> picture = nextPicture(true);
  picture.erase(picture.begin());
  picture.pop_back();
  arrive(picture);
  EXPECT_THAT(takeRequests(2), IsEmpty());
  arrive(nextPicture(true)[0]);
  EXPECT_THAT(takeRequests(2), ElementsAre(0u));
}

// Parities take time on the air from other pictures.
TEST_F(RepeatedDatagramsTest, ParitiesAreRequestedOnlyWhereTheLinkHasTimeForThem) {
  const auto parts = static_cast<int>(nextPicture().size());
  for (const int spare : {4, 1, 4}) {
    knowPace(milliseconds(5), milliseconds(5 * (parts + spare)));
    std::vector<Bytes> picture = nextPicture();
    picture.erase(picture.begin() + 1);
    arriveEach(milliseconds(5), picture);
    const Bytes report = encoded(protocol::version2::LossReport{numberOf(picture_)});
    EXPECT_EQ(spare == 4 ? std::vector<Bytes>{report} : std::vector<Bytes>(), repliesOf('l')) << spare;
    wait(milliseconds(5 * (spare + 1)));
  }
}

// Somebody who does not hear the connection does not know the numbers. These count from 0, or as far as a guess may go.
TEST_F(RepeatedDatagramsTest, ForgedDatagramsChangeNothing) {
  live(std::chrono::seconds(3), [this] {
    for (const unsigned start : {0U, order_.first_picture ^ 0x40000000U}) {
      unsigned sequence = start;
      arrive(test_support::makeDatagrams(makeJpeg(7), start, frameOf(picture_ + 1), &sequence, true));
    }
    arrive(nextPicture());
  });
  EXPECT_EQ("", connection_.transport_problem);
  EXPECT_EQ(PictureTransport::kUdp, connection_.transport);
  EXPECT_EQ(picture_, pictures_.size());
  EXPECT_THAT(delivered(), Each(testing::Gt(0u)));
  EXPECT_GE(counters_.bad_datagrams, picture_);
  EXPECT_TRUE(repliesOf('l').empty()) << "nothing was lost";
}

TEST_F(RepeatedDatagramsTest, EachOrderHasOtherNumbers) {
  const auto first = order_;
  wish_.datagram_port = kPort + 1;
  answer();
  EXPECT_EQ(kPort + 1, order_.port);
  EXPECT_NE(first.first_sequence, order_.first_sequence);
  EXPECT_NE(first.first_picture, order_.first_picture);
}

}  // namespace
