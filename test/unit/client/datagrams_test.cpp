// Pictures by UDP: what the client asks for, which pictures it delivers, and when it goes back to TCP.
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <future>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "client/fault.h"
#include "datagrams_fixture.h"
#include "newest_client_fixture.h"
#include "support/udp_socket.h"

using namespace aibo_client;
using std::chrono::milliseconds;
using test_pictures::Bytes;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using version2_frames::makeFrame;

namespace {

class DatagramsTest : public DatagramsFixture {
 protected:
  DatagramsTest() : DatagramsFixture("F W B") { wish_.transport = PictureTransport::kUdp; }
};

TEST_F(DatagramsTest, ThePortIsSentBeforeTheStreamIsRequested) {
  wish_.streaming = true;
  wish_.datagram_port = 0x1234;
  EXPECT_EQ('B', request());
  EXPECT_EQ(Bytes({0x12, 0x34}), payload_);
  EXPECT_EQ('W', request());
  EXPECT_EQ(0, request());
  wish_.datagram_port = 0;
  EXPECT_EQ('B', request());
  EXPECT_EQ(Bytes({0, 0}), payload_);
  receive(makeFrame('b', number_, payload_));
  EXPECT_EQ(PictureTransport::kTcp, connection_.transport);
}

TEST_F(DatagramsTest, APictureIsDeliveredWhenItIsWholeInAnyOrderOfItsParts) {
  startStream();
  EXPECT_EQ(PictureTransport::kUdp, connection_.transport);
  std::vector<Bytes> datagrams = nextPicture();
  ASSERT_GE(datagrams.size(), 3u);
  std::reverse(datagrams.begin(), datagrams.end());
  const Bytes last = datagrams.back();
  datagrams.pop_back();
  const TimePoint began = now_;
  arrive(datagrams);
  EXPECT_TRUE(pictures_.empty());
  pass(milliseconds(5));
  arrive(last);
  EXPECT_THAT(delivered(), ElementsAre(1));
  EXPECT_EQ(began, pictures_[0]->first_byte_time);
  EXPECT_EQ(frameOf(1), pictures_[0]->frame_number);
  EXPECT_EQ(12345u, pictures_[0]->image_count);
  EXPECT_EQ(176, pictures_[0]->width);
  EXPECT_EQ(144, pictures_[0]->height);
  EXPECT_EQ(datagrams.size(), counters_.reordered_datagrams);
  EXPECT_EQ(datagrams.size() + 1, counters_.datagrams);
}

TEST_F(DatagramsTest, APictureThatHasLostAPartIsLeftOutAndDelaysNoOther) {
  startStream();
  std::vector<Bytes> cut = nextPicture();
  cut.pop_back();
  arrive(nextPicture());
  arrive(cut);
  arrive(nextPicture());
  EXPECT_THAT(delivered(), ElementsAre(2, 3));
  EXPECT_EQ(1u, counters_.lost_pictures);
}

TEST_F(DatagramsTest, NoPictureIsDeliveredAfterANewerOne) {
  startStream();
  const std::vector<Bytes> older = nextPicture();
  arrive(nextPicture());
  arrive(older);
  EXPECT_THAT(delivered(), ElementsAre(2));
  EXPECT_EQ(1u, counters_.lost_pictures);
  EXPECT_EQ(older.size(), counters_.reordered_datagrams);
}

TEST_F(DatagramsTest, PartsOfTwoPicturesMayBeMixed) {
  startStream();
  const std::vector<Bytes> first = nextPicture();
  const std::vector<Bytes> second = nextPicture();
  for (std::size_t i = 0; i < std::max(first.size(), second.size()); ++i) {
    for (const auto* picture : {&second, &first}) {
      if (i + 1 < picture->size()) {
        arrive((*picture)[i]);
      }
    }
  }
  arrive(first.back());
  arrive(second.back());
  EXPECT_THAT(delivered(), ElementsAre(1, 2));
  EXPECT_EQ(0u, counters_.lost_pictures);
}

TEST_F(DatagramsTest, OfThreeIncompletePicturesTheOneThatHasWaitedLongestIsGivenUp) {
  startStream();
  std::vector<Bytes> first = nextPicture();
  const std::vector<Bytes> second = nextPicture();
  arrive(second.front());
  pass(milliseconds(1));
  arrive(first.back());
  first.pop_back();
  pass(milliseconds(1));
  arrive(nextPicture().front());
  arrive(first);
  EXPECT_THAT(delivered(), ElementsAre(1)) << "its number is the lowest, but the second one began before it";
}

TEST_F(DatagramsTest, DatagramsThatComeTwiceAreCountedAndDoNoHarm) {
  startStream();
  for (const Bytes& datagram : nextPicture()) {
    arrive(datagram);
    arrive(datagram);
  }
  arrive(nextPicture());
  EXPECT_THAT(delivered(), ElementsAre(1, 2));
  EXPECT_GE(counters_.duplicate_datagrams, 3u);
  EXPECT_EQ(0u, counters_.bad_datagrams);
}

TEST_F(DatagramsTest, NonsenseIsCountedLoggedOnceAndDoesNoHarm) {
  startStream();
  arrive(Bytes());
  arrive(Bytes(1400, 0x62));
  std::vector<Bytes> picture = nextPicture();
  for (std::size_t size = 0; size < picture[0].size(); size += 7) {
    arrive(Bytes(picture[0].begin(), picture[0].begin() + static_cast<std::ptrdiff_t>(size)));
  }
  Bytes from_the_far_future = picture[0];
  from_the_far_future[4] = 0x7f;
  arrive(from_the_far_future);
  Bytes of_a_picture_to_come = picture[0];
  of_a_picture_to_come[8] = 1;
  arrive(of_a_picture_to_come);
  Bytes ahead = picture[0];
  ahead[6] = 1;  // that many datagrams are never lost at once
  arrive(ahead);
  Bytes contradiction = picture[1];
  contradiction[19] ^= 1;  // the image count may differ, the frame may not
  contradiction[23] ^= 1;
  arrive(picture[0]);
  const std::uint64_t before = counters_.bad_datagrams;
  EXPECT_GE(before, 100u);
  arrive(contradiction);
  EXPECT_EQ(before + 1, counters_.bad_datagrams);
  arrive(picture);
  EXPECT_THAT(delivered(), ElementsAre(1));
  EXPECT_THAT(repliesOf('l'), IsEmpty());
  EXPECT_EQ(1, logged("that is dropped"));
}

// Of pictures that the robot never sent, in its name: whole ones that are no JPEGs, and incomplete ones, whose numbers
// are far ahead, or not so far.
TEST_F(DatagramsTest, ForgedOnesDoNotStopTheStream) {
  startStream();
  live(std::chrono::seconds(5), [this] {
    for (const unsigned picture : {60000U, 60001U, picture_ + 40, picture_ + 41, picture_ + 65, 100U}) {
      unsigned sequence = picture + 1;
      arrive(test_support::makeDatagrams(Bytes(100, 'x'), picture, kFrame, &sequence, false));
      std::vector<Bytes> incomplete = test_support::makeDatagrams(makeJpeg(7), picture, kFrame, &sequence, false);
      incomplete.pop_back();
      arrive(incomplete);
    }
    arrive(nextPicture());
  });
  EXPECT_EQ("", connection_.transport_problem);
  EXPECT_GE(pictures_.size(), picture_ * 9 / 10);
  EXPECT_GE(repliesOf('a').size(), picture_ * 9 / 10) << "the robot waits for them";
}

TEST_F(DatagramsTest, OnlyGoodPicturesPostponeTheReturnToTcp) {
  startStream();
  live(milliseconds(1500), [this] {
    wish_.datagram_port = connection_.transport_problem.empty() ? kPort : 0;
    arrive(test_support::makeDatagrams(Bytes(100, 'x'), picture_++, kFrame, &sequence_, false));
  });
  EXPECT_THAT(connection_.transport_problem, HasSubstr("datagrams come, but no good picture"));
  EXPECT_EQ(PictureTransport::kTcp, connection_.transport);
}

// Pictures of the robot's, sent again with other numbers, twice a second.
TEST_F(DatagramsTest, AForgedGoodPictureCostsAFewPicturesAtMost) {
  startStream();
  arrive(nextPicture());
  live(std::chrono::seconds(5), [this] {
    if (picture_ % 15 == 0) {
      for (const unsigned ahead : {60000U, 60001U, 65U, 40U, 20U, 3U}) {
        unsigned sequence = picture_ + ahead;
        arrive(test_support::makeDatagrams(makeJpeg(1), picture_ + ahead, frameOf(picture_ + 1), &sequence, false));
      }
    }
    arrive(nextPicture());
  });
  EXPECT_EQ("", connection_.transport_problem);
  EXPECT_GE(pictures_.size(), picture_ * 7 / 10);
  EXPECT_LT(0u, counters_.bad_datagrams);
}

// A computer that was held up finds some pictures in the system's buffer, which had no room for the ones after them.
TEST_F(DatagramsTest, AJumpInTheNumbersOfPicturesIsBelievedSoon) {
  startStream();
  live(milliseconds(900));
  arrive(nextPicture());
  for (int i = 0; i < 20; ++i) {
    nextPicture();
  }
  live(milliseconds(320), [this] { arrive(nextPicture()); });
  EXPECT_GE(pictures_.size(), 1U + 3U);
  EXPECT_EQ("", connection_.transport_problem);
}

TEST_F(DatagramsTest, APictureIsBelievedToBeAsFarAheadAsTheOutageWasLong) {
  startStream();
  arrive(nextPicture());
  for (int i = 0; i < 25; ++i) {
    nextPicture();
  }
  beOutOfReach(milliseconds(800));
  arrive(nextPicture());
  EXPECT_THAT(delivered(), ElementsAre(1, 27));
}

TEST_F(DatagramsTest, AForgedDatagramAfterASilenceDoesNotMakeLaterPicturesLate) {
  startStream();
  live(milliseconds(320), [this] { arrive(nextPicture()); });
  live(milliseconds(400));
  unsigned sequence = sequence_ + 20;
  arrive(test_support::makeDatagrams(makeJpeg(99), picture_ + 10, frameOf(1), &sequence, false).front());
  arrive(nextPicture());
  EXPECT_EQ(picture_, pictures_.size());
}

// Otherwise the robot would wait. It has gone on sending while this process was stopped.
TEST_F(DatagramsTest, APictureThatComesAfterALongJumpIsAcknowledged) {
  startStream();
  live(milliseconds(320), [this] { arrive(nextPicture()); });
  for (int i = 0; i < 70; ++i) {
    nextPicture();
  }
  now_ += milliseconds(70 * 32);
  arrive(nextPicture());
  EXPECT_EQ(Bytes({'a', 0, 0, 0, 0, 0, 0, static_cast<std::uint8_t>(picture_ - 1)}), repliesOf('a').back());
}

TEST_F(DatagramsTest, AFrameNumberOfTheFutureIsNotBelieved) {
  startStream();
  arrive(nextPicture());
  unsigned sequence = sequence_;
  constexpr unsigned kFuture = kFrame + 20;
  arrive(test_support::makeDatagrams(makeJpeg(1), picture_, kFuture, &sequence, false));
  EXPECT_THAT(delivered(), ElementsAre(1));
  nextPicture();  // its number is the forged one's
  arrive(nextPicture());
  EXPECT_THAT(delivered(), ElementsAre(1, 3));
  pass(milliseconds(250));
  EXPECT_EQ('H', request());
  const unsigned later = kFrame + 250 / 8 + 20;  // its clock is faster than this computer's
  pass(milliseconds(160));                       // the answer is as old
  receive(version2_frames::makeFrame('h', number_, version2_frames::makeHello(capabilities_, later)));
  arrive(test_support::makeDatagrams(makeJpeg(3), picture_, later + 160 / 8 + 10, &sequence_, false));
  EXPECT_THAT(delivered(), ElementsAre(1, 3, 3));
}

TEST_F(DatagramsTest, LostDatagramsAreCounted) {
  startStream();
  live(std::chrono::seconds(4), [this] {
    std::vector<Bytes> picture = nextPicture();
    if (picture_ % 4 == 0) {
      picture.erase(picture.begin());
    }
    arrive(picture);
  });
  EXPECT_EQ(picture_ / 4, counters_.lost_pictures);
  EXPECT_NEAR(picture_ / 4, static_cast<double>(counters_.lost_datagrams), 6) << "the last 64 are not counted yet";
  EXPECT_EQ(picture_ - picture_ / 4, pictures_.size());
}

TEST_F(DatagramsTest, WithoutADatagramForOneSecondThePicturesComeByTcp) {
  startStream();
  live(milliseconds(960));
  EXPECT_EQ("", connection_.transport_problem);
  live(milliseconds(300), [this] { wish_.datagram_port = connection_.transport_problem.empty() ? kPort : 0; });
  EXPECT_THAT(connection_.transport_problem, HasSubstr("no datagram has come for 1 s, while TCP works"));
  EXPECT_THAT(asked_, HasSubstr("B"));
  EXPECT_EQ(Bytes({0, 0}), port_);
  EXPECT_EQ(PictureTransport::kTcp, connection_.transport);
  EXPECT_TRUE(connection_.lets_no_datagram_through);
  EXPECT_EQ(1, logged("by TCP, not by UDP"));
  EXPECT_EQ(0, logged("info"));
  unsigned frame_number = frameOf(1000);
  live(std::chrono::seconds(3), [&] { receive(byTcp(1, frame_number += 4)); });
  EXPECT_GE(pictures_.size(), 90u);
}

TEST_F(DatagramsTest, AFlowOfOtherMessagesByTcpDoesNotHideThat) {
  startStream();
  live(milliseconds(1300), [this] {
    receive(makeFrame('t', 0, version2_frames::makeTelemetry(5000, {})));
    wish_.datagram_port = connection_.transport_problem.empty() ? kPort : 0;
  });
  EXPECT_NE("", connection_.transport_problem);
}

TEST_F(DatagramsTest, DatagramsThatStopComingAreNoticedToo) {
  startStream();
  live(std::chrono::seconds(3), [this] { arrive(nextPicture()); });
  live(milliseconds(1300), [this] { wish_.datagram_port = connection_.transport_problem.empty() ? kPort + 1 : 0; });
  EXPECT_NE("", connection_.transport_problem);
  EXPECT_FALSE(connection_.lets_no_datagram_through);
}

TEST_F(DatagramsTest, AnOutageOfTheRadioIsNoReasonForTcp) {
  for (const int outage : {600, 990, 1010, 1200}) {
    startStream();
    asked_.clear();
    for (int i = 0; i < 100 && asked_.empty();
         ++i) {  // the heartbeat of this connection endures the longest of these outages
      live(milliseconds(32), [this] { arrive(nextPicture()); });
    }
    beOutOfReach(milliseconds(outage));
    live(milliseconds(96));
    live(milliseconds(2000), [this] { arrive(nextPicture()); });
    EXPECT_EQ("", connection_.transport_problem) << outage;
  }
}

TEST_F(DatagramsTest, ARobotThatIsSilentByTcpTooIsGivenUp) {
  startStream();
  live(milliseconds(320), [this] { arrive(nextPicture()); });
  EXPECT_EQ("robot:54321 did not answer the request 'H' within 1000 ms",
            whyGivenUp([this] { beOutOfReach(milliseconds(2000)); }));
}

TEST_F(DatagramsTest, ASlowStreamMayTakeItsTime) {
  wish_.format.every_nth_image = 15;
  startStream();
  unsigned images = 0;
  live(std::chrono::seconds(10), [&] {
    if (++images % 47 == 0) {  // each 1.5 s: two of three are lost whole, and a part of every other one
      std::vector<Bytes> picture = nextPicture();
      picture.resize(picture.size() - images % 2);
      arrive(picture);
    }
  });
  EXPECT_EQ("", connection_.transport_problem);
}

TEST_F(DatagramsTest, WithoutAWholePictureInTwentyThePicturesComeByTcpWhereSilenceIsAFault) {
  startStream();
  live(std::chrono::seconds(1), [this] {
    wish_.datagram_port = connection_.transport_problem.empty() ? kPort : 0;
    std::vector<Bytes> picture = nextPicture();
    picture.pop_back();
    arrive(picture);
  });
  EXPECT_THAT(connection_.transport_problem, HasSubstr("no picture is complete"));
  EXPECT_FALSE(connection_.lets_no_datagram_through);
  ASSERT_EQ(PictureTransport::kTcp, connection_.transport);
  EXPECT_EQ(kSilentStream, whyGivenUp([this] { live(std::chrono::seconds(1)); }));
}

TEST_F(DatagramsTest, AWholePictureNowAndThenIsEnough) {
  startStream();
  live(std::chrono::seconds(5), [this] {
    std::vector<Bytes> picture = nextPicture();
    if (picture_ % 4 != 0) {
      picture.pop_back();
    }
    arrive(picture);
  });
  EXPECT_EQ("", connection_.transport_problem);
  EXPECT_EQ(3 * (picture_ / 4), counters_.lost_pictures) << "each is counted, also if it was given up for newer ones";
}

TEST_F(DatagramsTest, NothingIsDueWhileTheStreamIsOff) {
  wish_.datagram_port = kPort;
  live(std::chrono::seconds(5));
  EXPECT_EQ("", connection_.transport_problem);
  wish_.streaming = true;
  live(milliseconds(900));
  EXPECT_EQ("", connection_.transport_problem);
}

TEST_F(DatagramsTest, ARefusalMeansTcp) {
  wish_.streaming = true;
  wish_.datagram_port = kPort;
  EXPECT_EQ('B', request());
  receive(makeFrame('e', number_, version2_frames::makeError(0, "no endpoint")));
  EXPECT_EQ("it refused to: no endpoint", connection_.transport_problem);
  EXPECT_FALSE(connection_.lets_no_datagram_through) << "over the next connection it may agree";
  EXPECT_EQ(1u, counters_.refusals);
  wish_.datagram_port = 0;
  answer();
  receive(byTcp(1, frameOf(1)));
  EXPECT_EQ(1u, pictures_.size());
}

TEST_F(DatagramsTest, ARefusalThatComesAfterTheNextWishIsNoProblem) {
  const auto want = [this](PictureTransport transport) {
    wish_.transport = transport;
    ++wish_.transport_changes;
    wish_.datagram_port = transport == PictureTransport::kTcp ? 0 : kPort;
    EXPECT_EQ('B', request());
    return number_;
  };
  for (const bool is_wanted_again : {false, true}) {
    const int refused = want(PictureTransport::kUdp);
    want(PictureTransport::kTcp);
    receive(makeFrame('b', number_, payload_));
    if (is_wanted_again) {
      want(PictureTransport::kUdp);
    }
    receive(makeFrame('e', refused, version2_frames::makeError(7, "no endpoint")));
    EXPECT_EQ("", connection_.transport_problem);
  }
  EXPECT_EQ(0, logged("by TCP, not by UDP"));
}

TEST_F(DatagramsTest, PicturesByTcpThatWereOvertakenAreNotDelivered) {
  startStream();
  auto answer_of_call = takePicture(90);
  EXPECT_EQ('F', request());
  const int number = number_;
  arrive(nextPicture());
  receive(byTcp(50, kFrame));              // a picture of the stream that waited in TCP
  receive(byTcp(60, kFrame + 2, number));  // the one that was asked for
  EXPECT_THAT(delivered(), ElementsAre(1));
  ASSERT_TRUE(done(answer_of_call));
  EXPECT_EQ(makeJpeg(60), answer_of_call.get().picture->jpeg);
  EXPECT_EQ(1u, counters_.stale_pictures);
  receive(byTcp(51, frameOf(1) + 1));
  EXPECT_EQ(2u, pictures_.size());
  arrive(nextPicture());
  EXPECT_EQ(3u, pictures_.size());
  receive(byTcp(2, frameOf(2)));  // the same one
  EXPECT_EQ(3u, pictures_.size());
}

TEST_F(DatagramsTest, APictureByUdpThatARequestedOneHasOvertakenIsNotDelivered) {
  startStream();
  const auto answer = takePicture(85);
  EXPECT_EQ('F', request());
  const std::vector<Bytes> late = nextPicture();
  receive(byTcp(90, frameOf(picture_) + 4, number_));
  EXPECT_TRUE(done(answer));
  arrive(late);
  EXPECT_EQ(1u, pictures_.size());
  EXPECT_EQ(1u, counters_.stale_pictures);
}

TEST_F(DatagramsTest, EachPictureIsAcknowledgedWhenItsLastPartOrALaterOneHasCome) {
  startStream();
  arrive(nextPicture());
  EXPECT_THAT(repliesOf('a'), ElementsAre(Bytes({'a', 0, 0, 0, 0, 0, 0, 0})));
  std::vector<Bytes> picture = nextPicture();
  arrive(picture.back());
  EXPECT_EQ(2u, repliesOf('a').size());
  picture.pop_back();
  arrive(picture);
  EXPECT_EQ(2u, repliesOf('a').size());
  EXPECT_EQ(Bytes({'a', 0, 0, 0, 0, 0, 0, 1}), repliesOf('a').back());
  std::vector<Bytes> cut = nextPicture();
  cut.pop_back();
  const std::size_t before = repliesOf('a').size();
  arrive(cut);
  arrive(Bytes(10, 'x'));
  EXPECT_EQ(before, repliesOf('a').size());
  arrive(nextPicture().front());
  EXPECT_EQ(Bytes({'a', 0, 0, 0, 0, 0, 0, 2}), repliesOf('a').back()) << "its last part will not come any more";
}

TEST_F(DatagramsTest, AnyDatagramOfAGroupWithParityMayBeLost) {
  startStream();
  const std::size_t datagrams = nextPicture(true).size();
  picture_ = 0;
  jpegs_.clear();
  sequence_ = 0;
  for (std::size_t lost = 0; lost < datagrams; ++lost) {
    std::vector<Bytes> picture = nextPicture(true);
    picture.erase(picture.begin() + static_cast<std::ptrdiff_t>(std::min(lost, picture.size() - 1)));
    pass(milliseconds(32));
    arrive(picture);
    ASSERT_EQ(delivered().size(), picture_) << lost;
    EXPECT_EQ(delivered().back(), picture_) << lost;
  }
  EXPECT_EQ(datagrams - 1, counters_.repaired_datagrams) << "a lost parity needs no repair";
  EXPECT_EQ(0u, counters_.lost_pictures);
  EXPECT_EQ(0u, counters_.bad_datagrams);
}

TEST_F(DatagramsTest, EachGroupOfALargePictureMayLoseADatagram) {
  startStream();
  std::vector<Bytes> picture = nextLargePicture();
  ASSERT_GT(picture.size(), 2 * protocol::version2::PARTS_PER_PARITY);
  picture.erase(picture.end() - 2);    // the last part
  picture.erase(picture.begin() + 9);  // the first of the second group, behind the parity of the first
  std::reverse(picture.begin(), picture.end());
  const Bytes last = picture.back();
  picture.pop_back();
  arrive(picture);
  EXPECT_THAT(delivered(), ElementsAre(1)) << "the first part, too, is made from its parity";
  EXPECT_EQ(3u, counters_.repaired_datagrams);
  arrive(last);
  EXPECT_THAT(delivered(), ElementsAre(1));
}

TEST_F(DatagramsTest, ADatagramThatWasRepairedAndComesLateIsADuplicate) {
  startStream();
  std::vector<Bytes> picture = nextLargePicture();
  const Bytes of_first_group = picture[3];
  const Bytes of_second_group = picture[10];
  picture.erase(picture.begin() + 17);  // the parity of the second group
  picture.erase(picture.begin() + 10);
  picture.erase(picture.begin() + 3);
  arrive(picture);
  EXPECT_EQ(1u, counters_.repaired_datagrams);
  arrive(of_first_group);
  EXPECT_THAT(delivered(), IsEmpty()) << "a part of the second group is missing";
  arrive(of_second_group);
  EXPECT_THAT(delivered(), ElementsAre(1));
}

TEST_F(DatagramsTest, TwoLostDatagramsOfAGroupCannotBeRepaired) {
  startStream();
  std::vector<Bytes> picture = nextPicture(true);
  const Bytes late = picture[0];
  picture.erase(picture.begin(), picture.begin() + 2);
  arrive(picture);
  EXPECT_THAT(delivered(), IsEmpty());
  arrive(late);
  EXPECT_THAT(delivered(), ElementsAre(1)) << "one is lost, the other was late";
}

TEST_F(DatagramsTest, ALossIsReportedWhenALaterDatagramShowsIt) {
  startStream();
  arrive(nextPicture());
  EXPECT_THAT(repliesOf('l'), IsEmpty());
  std::vector<Bytes> picture = nextPicture();
  picture.erase(picture.begin() + 1);
  arrive(picture);
  EXPECT_THAT(repliesOf('l'), ElementsAre(Bytes({'l', 0, 0, 0, 0, 0, 0, 1})));
  picture = nextPicture();
  picture.pop_back();
  arrive(picture);
  EXPECT_EQ(1u, repliesOf('l').size());
  arrive(nextPicture());
  EXPECT_EQ(2u, repliesOf('l').size());
}

TEST_F(DatagramsTest, TheParityOfTheLastPartsAcknowledgesToo) {
  startStream();
  std::vector<Bytes> picture = nextPicture(true);
  const Bytes parity = picture.back();
  picture.resize(picture.size() - 2);  // without the last part
  arrive(picture);
  EXPECT_THAT(replies_, IsEmpty());
  arrive(parity);
  EXPECT_THAT(replies_, testing::Contains(Bytes({'a', 0, 0, 0, 0, 0, 0, 0})));
  EXPECT_THAT(delivered(), ElementsAre(1));
}

TEST_F(DatagramsTest, TheAcknowledgementOfAPictureWithParitiesIsRepeated) {
  startStream();
  arrive(nextPicture());
  arrive(nextPicture(true));
  EXPECT_EQ(2u, repliesOf('a').size()) << "that of a picture without is not";
  arrive(nextPicture().front());
  EXPECT_EQ(3u, repliesOf('a').size());
  EXPECT_EQ(Bytes({'a', 0, 0, 0, 0, 0, 0, 1}), repliesOf('a').back());
}

TEST_F(DatagramsTest, ANewPortBeginsToCountAgain) {
  startStream();
  live(std::chrono::seconds(1), [this] { arrive(nextPicture()); });
  // The third port follows one over which only the first picture was acknowledged.
  for (const int port : {kPort + 1, kPort + 2}) {
    wish_.datagram_port = 0;
    answer();
    wish_.datagram_port = port;
    answer();
    const std::size_t before = pictures_.size();
    replies_.clear();
    unsigned sequence = 0;
    arrive(test_support::makeDatagrams(makeJpeg(90), 0, frameOf(++picture_), &sequence));
    EXPECT_EQ(before + 1, pictures_.size());
    EXPECT_THAT(replies_, ElementsAre(Bytes({'a', 0, 0, 0, 0, 0, 0, 0})));
    EXPECT_EQ(0u, counters_.reordered_datagrams + counters_.duplicate_datagrams + counters_.lost_datagrams);
  }
}

TEST_F(DatagramsTest, TheAnswerAboutAnOlderPortIsNotTheOneAboutTheNewOne) {
  wish_.streaming = true;
  wish_.datagram_port = kPort;
  ASSERT_EQ('B', request());
  const Bytes older = version2_frames::makeFrame('b', number_, payload_);
  wish_.datagram_port = kPort + 1;
  ASSERT_EQ('B', request());
  receive(older);
  EXPECT_EQ(PictureTransport::kTcp, connection_.transport);
  receive(version2_frames::makeFrame('b', number_, payload_));
  EXPECT_EQ(PictureTransport::kUdp, connection_.transport);
}

TEST_F(DatagramsTest, ANewPortHasAsMuchTimeForItsFirstPictureAsTheFirstOne) {
  const auto send_by_tcp = [this] {
    ++picture_;
    receive(byTcp(picture_, frameOf(picture_)));
  };
  startStream();
  live(std::chrono::seconds(1), [this] { arrive(nextPicture()); });
  wish_.datagram_port = 0;
  live(std::chrono::seconds(3), send_by_tcp);
  wish_.datagram_port = kPort + 1;
  ASSERT_EQ('B', request());
  const Bytes reply = version2_frames::makeFrame('b', number_, payload_);
  live(milliseconds(900), send_by_tcp);
  receive(reply);
  EXPECT_EQ(PictureTransport::kUdp, connection_.transport);
  live(milliseconds(900));
  EXPECT_EQ(PictureTransport::kUdp, connection_.transport) << "the time begins with the answer";
}

TEST_F(DatagramsTest, OverANewPortNothingIsRepliedToDatagramsFromBeforeTheReturnToTcp) {
  startStream();
  for (int i = 0; i < 100 && connection_.transport == PictureTransport::kUdp; ++i) {
    std::vector<Bytes> picture = nextPicture();
    picture.pop_back();
    arrive(picture);
  }
  wish_.datagram_port = 0;
  answer();
  EXPECT_EQ(PictureTransport::kTcp, connection_.transport);
  replies_.clear();
  ++wish_.transport_changes;
  wish_.datagram_port = kPort + 1;
  answer();
  EXPECT_THAT(replies_, IsEmpty());
}

// Such a number would be plausible some time after the last picture, or after another number that is not.
TEST_F(DatagramsTest, ANumberFarAheadIsNotBelievedOverANewPortBecauseOfWhatCameBefore) {
  startStream();
  live(milliseconds(900));
  arrive(nextPicture());
  for (int i = 0; i < 20; ++i) {
    nextPicture();
  }
  arrive(nextPicture());
  EXPECT_THAT(delivered(), ElementsAre(1)) << "the other one is too far ahead";
  wish_.streaming = false;
  wish_.datagram_port = 0;
  live(std::chrono::seconds(2));
  wish_.streaming = true;
  wish_.datagram_port = kPort + 1;
  answer();
  unsigned sequence = 60;
  arrive(test_support::makeDatagrams(makeJpeg(90), 30, frameOf(picture_), &sequence));
  EXPECT_THAT(delivered(), ElementsAre(1));
}

TEST_F(DatagramsTest, AfterTheReturnToTcpThereIsTimeForAPicture) {
  startStream();
  live(std::chrono::seconds(2), [this] { arrive(nextPicture()); });
  wish_.datagram_port = 0;
  live(milliseconds(300));
  receive(byTcp(99, frameOf(2000)));
  EXPECT_EQ(picture_ + 1, pictures_.size());
}

TEST_F(DatagramsTest, DatagramsAfterTheReturnToTcpAreIgnored) {
  startStream();
  arrive(nextPicture());
  wish_.datagram_port = 0;
  answer();
  arrive(nextPicture());
  EXPECT_THAT(delivered(), ElementsAre(1));
}

// ------------------------------------------------------------------------------------------------ with sockets

class DatagramClientTest : public NewestClientFixture {
 protected:
  /// @return the port that the client names; 0 if it names none
  static int portIn(const version2_frames::Frame& frame) {
    return frame.header.kind == 'B' ? frame.payload.at(0) * 256 + frame.payload.at(1) : 0;
  }

  static void confirm(ScriptedPeer* peer, const version2_frames::Frame& frame) {
    peer->send(makeFrame(protocol::version2::replyKind(frame.header.kind), frame.header.request_number, frame.payload));
  }

  /// @return the client's port
  int startStream(ScriptedPeer* peer) {
    const version2_frames::Frame port = peer->readRequest();
    confirm(peer, port);
    confirm(peer, peer->readRequest());
    return portIn(port);
  }

  void sendPicture(test_support::UdpSocket* socket, int port) {
    const std::vector<Bytes> datagrams =
        test_support::makeDatagrams(makeJpeg(picture_), picture_, 100 + picture_, &sequence_);
    ++picture_;
    for (const Bytes& datagram : datagrams) {
      socket->send(port, datagram);
    }
  }

  unsigned picture_ = 0;
  unsigned sequence_ = 0;
};

TEST_F(DatagramClientTest, PicturesComeFromTheRobotsAddressAlone) {
  client().setPictureTransport(PictureTransport::kUdp);
  client().setStreaming(true);
  ScriptedPeer peer = connectVersion2("F W B");
  const int port = startStream(&peer);
  ASSERT_GT(port, 0);
  test_support::UdpSocket stranger("127.0.0.2");
  test_support::UdpSocket robot;
  unsigned sequence = 0;
  const std::vector<Bytes> forged = test_support::makeDatagrams(makeJpeg(99), 0, 100, &sequence);
  const std::uint64_t received = client().statistics().bytes_received;
  std::size_t sent = 0;
  for (const Bytes& datagram : forged) {
    stranger.send(port, datagram);
    sent += datagram.size();
  }
  EXPECT_TRUE(eventually([&] { return client().statistics().foreign_datagrams == forged.size(); }));
  EXPECT_GE(client().statistics().bytes_received, received + sent) << "also those";
  sendUntilDelivered(client(), [&] { sendPicture(&robot, port); });
  ASSERT_FALSE(recorder_.pictures().empty());
  EXPECT_NE(makeJpeg(99), recorder_.pictures().front()->jpeg);
  EXPECT_EQ(PictureTransport::kUdp, client().status().transport);
  EXPECT_EQ("", client().status().transport_problem);
  std::optional<Bytes> reply;
  EXPECT_TRUE(eventually([&] { return (reply = robot.next()).has_value(); }));
  EXPECT_EQ(Bytes({'a', 0, 0, 0, 0, 0, 0, 0}), reply) << "the first picture has come";
  EXPECT_FALSE(stranger.next());

  robot.send(port, test_support::makeDatagrams(makeJpeg(picture_), picture_, 100 + picture_, &sequence_).back());
  const auto number = static_cast<std::uint8_t>(picture_++);
  std::set<Bytes> replies;
  EXPECT_TRUE(eventually([&] {
    replies.insert((reply = robot.next()).value_or(Bytes()));
    return replies.count({'a', 0, 0, 0, 0, 0, 0, number}) + replies.count({'l', 0, 0, 0, 0, 0, 0, number}) == 2;
  })) << "it is told that the last part has come, and that others are lost";

  peer.close();
  ScriptedPeer next_peer = connectVersion2("F W B");
  const int next_port = startStream(&next_peer);
  test_support::UdpSocket rebooted;
  picture_ = sequence_ = 0;
  sendUntilDelivered(client(), [&] { sendPicture(&rebooted, next_port); });
  EXPECT_TRUE(eventually([&] { return rebooted.next().has_value(); })) << "a robot that has rebooted has another port";
}

TEST_F(DatagramClientTest, WithoutAFreeSocketPicturesComeByTcpAndTheReasonIsTold) {
  client().setStreaming(true);
  ScriptedPeer peer = connectVersion2("F W B");
  confirm(&peer, peer.readRequest());
  rlimit usual{};
  ::getrlimit(RLIMIT_NOFILE, &usual);
  rlimit exhausted = usual;
  const int lowest_free = ::dup(STDERR_FILENO);
  ::close(lowest_free);
  exhausted.rlim_cur = static_cast<rlim_t>(lowest_free);
  ::setrlimit(RLIMIT_NOFILE, &exhausted);
  client().setPictureTransport(PictureTransport::kUdp);
  EXPECT_TRUE(eventually([&] { return client().status().transport_problem == "this computer has no free socket"; }));
  ::setrlimit(RLIMIT_NOFILE, &usual);
  EXPECT_EQ(PictureTransport::kTcp, client().status().transport);
  client().setPictureTransport(PictureTransport::kTcp);
  client().setPictureTransport(PictureTransport::kUdp);
  EXPECT_GT(portIn(peer.readRequest()), 0);
}

// The callback takes longer than StallDetector::kStallLimit.
TEST_F(DatagramClientTest, APictureThatHasWaitedForACallbackIsDroppedWhicheverWayItCame) {
  for (const PictureTransport way : {PictureTransport::kTcp, PictureTransport::kUdp}) {
    ScriptedServer server;
    Recorder recorder;
    Callbacks callbacks = recorder.callbacks();
    std::promise<void> in_callback;
    std::promise<void> release;
    callbacks.on_picture = [&, record = callbacks.on_picture, is_first = true](const PicturePtr& picture) mutable {
      record(picture);
      if (std::exchange(is_first, false)) {
        in_callback.set_value();
        release.get_future().wait();
      }
    };
    ClientOptions options = optionsFor(server);
    options.picture_transport = way;
    RcServerClient client(options, callbacks);
    client.setStreaming(true);
    client.start();
    ScriptedPeer peer = server.accept();
    peer.agreeToVersion2("F W B");
    test_support::UdpSocket robot;
    picture_ = sequence_ = 0;
    const int port = way == PictureTransport::kUdp ? startStream(&peer) : 0;
    const auto send_picture = [&] {
      if (port != 0) {
        return sendPicture(&robot, port);
      }
      peer.send(makeFrame('f', 0, version2_frames::makePicture(makeJpeg(picture_), 100 + picture_)));
      ++picture_;
    };
    const auto begun = in_callback.get_future();
    ASSERT_TRUE(eventually([&] {
      send_picture();
      return begun.wait_for(milliseconds(10)) == std::future_status::ready;
    }));
    const unsigned waits = picture_;
    send_picture();
    std::this_thread::sleep_for(milliseconds(150));
    release.set_value();
    sendUntilDelivered(client, send_picture);
    EXPECT_GT(client.statistics().stale_pictures, 0u);
    for (const PicturePtr& picture : recorder.pictures()) {
      EXPECT_NE(picture->jpeg, makeJpeg(waits));
    }
  }
}

TEST_F(DatagramClientTest, TheWholeIpv6AddressOfTheRobotIsCompared) {
  ClientOptions options = optionsFor(server_);
  options.host = "::ffff:127.0.0.1";  // every computer has it
  options.picture_transport = PictureTransport::kUdp;
  RcServerClient client(options, recorder_.callbacks());
  client.setStreaming(true);
  client.start();
  ScriptedPeer peer = server_.accept();
  peer.agreeToVersion2("F W B");
  test_support::UdpSocket("127.0.0.2").send(startStream(&peer), {0});
  EXPECT_TRUE(eventually([&] { return client.statistics().foreign_datagrams == 1; }));
}

TEST_F(DatagramClientTest, TheTransportCanBeChangedWhileTheStreamRuns) {
  client().setStreaming(true);
  ScriptedPeer peer = connectVersion2("F W B");
  confirm(&peer, peer.readRequest());
  client().setPictureTransport(PictureTransport::kUdp);
  const version2_frames::Frame on = peer.readRequest();
  EXPECT_GT(portIn(on), 0);
  EXPECT_TRUE(recorder_.waitForStatus(
      [](const ConnectionStatus& status) { return status.wanted_transport == PictureTransport::kUdp; }));
  confirm(&peer, on);
  EXPECT_TRUE(recorder_.waitForStatus(
      [](const ConnectionStatus& status) { return status.transport == PictureTransport::kUdp; }));
  client().setPictureTransport(PictureTransport::kTcp);
  const version2_frames::Frame off = peer.readRequest();
  EXPECT_EQ('B', off.header.kind);
  EXPECT_EQ(Bytes({0, 0}), off.payload);
  confirm(&peer, off);
  EXPECT_TRUE(eventually([&] { return client().status().transport == PictureTransport::kTcp; }));
}

TEST_F(DatagramClientTest, AServerWithoutTheRequestSendsByTcpAndTheReasonIsTold) {
  client().setPictureTransport(PictureTransport::kUdp);
  client().setStreaming(true);
  ScriptedPeer peer = connectVersion2("F W");
  EXPECT_EQ('W', peer.readRequest().header.kind);
  EXPECT_TRUE(recorder_.waitForStatus([](const ConnectionStatus& status) {
    return status.state == ConnectionState::kConnected &&
           status.transport_problem.find("no request for it") != std::string::npos;
  }));
  EXPECT_EQ(1, recorder_.logged("by TCP, not by UDP"));
}

TEST_F(DatagramClientTest, ARobotThatRefusesToSendDatagramsIsAskedAgainOverTheNextConnection) {
  client().setPictureTransport(PictureTransport::kUdp);
  client().setStreaming(true);
  ScriptedPeer peer = connectVersion2("F W B");
  const version2_frames::Frame order = peer.readRequest();
  EXPECT_GT(portIn(order), 0);
  confirm(&peer, peer.readRequest());
  peer.send(makeFrame('e', order.header.request_number, version2_frames::makeError(7, "no endpoint")));
  EXPECT_EQ("B 0 0 0", version2_frames::textOf(peer.readRequest()));
  EXPECT_EQ("it refused to: no endpoint", client().status().transport_problem);
  sendUntilDelivered(client(), [&] { peer.send(makeFrame('f', 0, version2_frames::makePicture(makeJpeg(1), 7))); });
  peer.close();
  ScriptedPeer next = connectVersion2("F W B");
  EXPECT_GT(startStream(&next), 0) << "it may agree now";
  EXPECT_TRUE(eventually([&] { return client().status().transport == PictureTransport::kUdp; }));
  next.close();
  EXPECT_TRUE(recorder_.waitForState(ConnectionState::kDisconnected));
  EXPECT_EQ(PictureTransport::kTcp, client().status().transport) << "without a connection none is in use";
}

TEST_F(DatagramClientTest, WhereNoDatagramEverCameUdpIsTriedAgainOnlyIfAskedFor) {
  client().setPictureTransport(PictureTransport::kUdp);
  client().setStreaming(true);
  ScriptedPeer first = connectVersion2("F W B");
  startStream(&first);
  const version2_frames::Frame off = first.readRequest();  // after 1 s
  EXPECT_EQ('B', off.header.kind);
  EXPECT_EQ(Bytes({0, 0}), off.payload);
  EXPECT_THAT(client().status().transport_problem, HasSubstr("no datagram"));
  first.close();
  ScriptedPeer second = server_.accept();
  for (int connection = 2; connection <= 3; ++connection) {
    if (connection == 2) {
      second.agreeToVersion2("F W B X");
      EXPECT_EQ(1, second.readRequest().payload.at(2)) << "first it is to send a test";
    } else {
      second.agreeToVersion2("F W B");
    }
    EXPECT_EQ('W', second.readRequest().header.kind) << connection;
    EXPECT_THAT(client().status().transport_problem, HasSubstr("no datagram"));
    if (connection == 2) {
      client().setPictureTransport(PictureTransport::kUdp);  // this changes nothing
      second.close();
      second = server_.accept();
    }
  }
  client().setPictureTransport(PictureTransport::kTcp);
  client().setPictureTransport(PictureTransport::kUdp);  // before the client's thread has seen the other one
  EXPECT_GT(portIn(second.readRequest()), 0);
  EXPECT_TRUE(eventually([&] { return client().status().transport_problem.empty(); }));
  second.close();
  ScriptedPeer third = server_.accept();
  third.agreeToVersion2("F W B");
  EXPECT_GT(portIn(third.readRequest()), 0) << "the block was for the earlier wish";
}

}  // namespace
