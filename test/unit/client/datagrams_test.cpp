// Pictures by UDP: what the client asks for, which pictures it delivers in which order, and when it goes back to TCP.
#include "datagrams_fixture.h"

using namespace aibo_client;
using std::chrono::milliseconds;
using test_pictures::Bytes;
using testing::ElementsAre;
using testing::IsEmpty;
using version2_frames::makeFrame;

namespace {

using Status = protocol::version2::DatagramStatus;

class DatagramsTest : public DatagramsFixture {
 public:
  DatagramsTest() {
    wanted_.transport = PictureTransport::kUdp;
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

class DatagramOrderTest : public DatagramsFixture {
 public:
  DatagramOrderTest() {
    wanted_.transport = PictureTransport::kUdp;
    wanted_.streaming = true;
    wanted_.datagram_port = 0x1234;
    EXPECT_EQ('B', request());
    const Bytes test = testDatagram(payload_);
    answer(payload_);
    arrive(test);
    EXPECT_EQ('B', request()) << "before the stream";
  }
};

TEST_F(DatagramOrderTest, NamesThePortOnceUntilItChangesWithOtherNumbersEachTime) {
  EXPECT_EQ(0x1234, order_.port);
  EXPECT_EQ('W', request());
  EXPECT_EQ(0, request());
  const auto first = order_;
  wanted_.datagram_port = kPort;
  EXPECT_EQ('B', request());
  EXPECT_EQ(kPort, order_.port);
  EXPECT_NE(first.first_sequence, order_.first_sequence) << "a stranger cannot guess them";
  EXPECT_NE(first.first_picture, order_.first_picture);
  wanted_.datagram_port = 0;
  EXPECT_EQ('B', request());
  EXPECT_EQ(0, order_.port);
  answer(payload_);
  EXPECT_EQ(PictureTransport::kTcp, connection_.status.transport);
}

TEST_F(DatagramOrderTest, ThatIsRefusedMeansTcp) {
  refuse("no endpoint");
  EXPECT_EQ("it refused to: no endpoint", connection_.status.transport_problem);
  EXPECT_EQ(1u, counters_.refusals);
  answer();
  arriveByTcp(1, frameOf(1));
  EXPECT_EQ(1u, pictures_.size());
}

// Anybody can forge a datagram.
TEST_F(DatagramsTest, APictureByUdpDoesNotTellUntilWhenOrdersAreGood) {
  arrive(makeDatagrams(makeJpeg(1), numberOf(1), kFrame + 12, &sequence_));
  ASSERT_EQ(1u, pictures_.size()) << "96 ms ahead may be true";
  arrive(makeDatagrams(makeJpeg(2), numberOf(2), kFrame + 1000000, &sequence_));
  commandJoints({{2, 0.1}});
  EXPECT_EQ('J', request());
  EXPECT_EQ(kFrame + 62, protocol::decodeBigEndian32(payload_.data()));
}

TEST_F(DatagramsTest, APictureIsDeliveredWhenItIsWholeInAnyOrderOfItsParts) {
  EXPECT_EQ(PictureTransport::kUdp, connection_.status.transport);
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
  EXPECT_EQ(12345u + numberOf(1), pictures_[0]->image_count);
  EXPECT_EQ(176, pictures_[0]->width);
  EXPECT_EQ(datagrams.size(), counters_.reordered_datagrams);
  EXPECT_EQ(datagrams.size() + 1, counters_.datagrams);
}

TEST_F(DatagramsTest, NonsenseIsCountedLoggedOnceAndDoesNoHarm) {
  const std::vector<Bytes> picture = nextPicture();
  const auto changed = [](Bytes datagram, std::size_t at, int bits) {
    datagram[at] ^= static_cast<std::uint8_t>(bits);
    return datagram;
  };
  const std::pair<std::string, Bytes> rows[] = {
      {"too large", Bytes(1400, 'b')},
      {"cut", Bytes(picture[0].begin(), picture[0].end() - 1)},
      {"a datagram of the far future", changed(picture[0], 4, 0x7f)},
      {"a picture of the far future", changed(picture[0], 8, 1)},
      {"a part of a different frame from those before", changed(picture[1], 23, 1)},
  };
  arrive(picture[0]);
  for (const auto& [name, datagram] : rows) {
    const std::uint64_t before = counters_.bad_datagrams;
    arrive(datagram);
    EXPECT_EQ(before + 1, counters_.bad_datagrams) << name;
  }
  arrive(picture);
  EXPECT_THAT(delivered(), ElementsAre(1));
  EXPECT_EQ(1, logged("that is dropped"));
}

TEST_F(DatagramsTest, APictureMayBe256AheadOfTheLastOne) {
  arrive(nextPicture());
  for (const unsigned ahead : {256U, 257U}) {
    unsigned sequence = order_.first_sequence + 1000;
    arrive(makeDatagrams(makeJpeg(1), numberOf(picture_) + ahead, frameOf(picture_), &sequence).front());
    EXPECT_EQ(ahead - 256, counters_.bad_datagrams) << ahead;
  }
}

// Pictures in the robot's name that it never sent: whole ones that are no JPEGs, and incomplete ones, with numbers far
// ahead or a little ahead.
TEST_F(DatagramsTest, ForgedOnesDoNotStopTheStream) {
  live(std::chrono::seconds(5), [this] {
    for (const unsigned picture : {60000U, 60001U, picture_ + 40, picture_ + 65, 100U}) {
      unsigned sequence = order_.first_sequence + picture;
      arrive(makeDatagrams(Bytes(100, 'x'), numberOf(picture), kFrame, &sequence));
      std::vector<Bytes> incomplete = makeDatagrams(makeJpeg(7), numberOf(picture), kFrame, &sequence);
      incomplete.pop_back();
      arrive(incomplete);
    }
    arrive(nextPicture());
  });
  EXPECT_EQ("", connection_.status.transport_problem);
  EXPECT_GE(pictures_.size(), picture_ * 9 / 10);
}

TEST_F(DatagramsTest, AFrameNumberOfTheFutureIsNotBelieved) {
  arrive(nextPicture());
  unsigned sequence = sequence_;
  arrive(makeDatagrams(makeJpeg(1), numberOf(picture_ + 1), kFrame + 200, &sequence));
  EXPECT_THAT(delivered(), ElementsAre(1));
  arrive(nextPicture());
  EXPECT_THAT(delivered(), ElementsAre(1, 2));
}

TEST_F(DatagramsTest, AForgedGoodPictureThatIsFarAheadBringsTheReturnToTcpAtWorst) {
  arrive(nextPicture());
  unsigned sequence = order_.first_sequence + 200;
  arrive(makeDatagrams(makeJpeg(1), numberOf(picture_ + 100), frameOf(picture_ + 1), &sequence));
  live(milliseconds(1300), [this] { arrive(nextPicture()); });
  EXPECT_EQ(PictureTransport::kTcp, connection_.status.transport);
}

TEST_F(DatagramsTest, OnlyGoodPicturesPostponeTheReturnToTcp) {
  live(milliseconds(1300),
       [this] { arrive(makeDatagrams(Bytes(100, 'x'), numberOf(++picture_), kFrame, &sequence_)); });
  EXPECT_THAT(connection_.status.transport_problem, testing::HasSubstr("datagrams come, but no good picture"));
  EXPECT_EQ(PictureTransport::kTcp, connection_.status.transport);
}

TEST_F(DatagramsTest, APictureIsBelievedToBeAsFarAheadAsTheOutageWasLong) {
  arrive(nextPicture());
  for (int i = 0; i < 25; ++i) {
    nextPicture();
  }
  beOutOfReach(milliseconds(800));
  arrive(nextPicture());
  EXPECT_THAT(delivered(), ElementsAre(1, 27));
}

TEST_F(DatagramsTest, AnOutageOfTheRadioIsNoReasonForTcp) {
  for (const int outage : {600, 990, 1010, 1200}) {
    asked_.clear();
    while (asked_.empty()) {  // just after a heartbeat, the connection endures the longest of these outages
      live(milliseconds(32), [this] { arrive(nextPicture()); });
    }
    beOutOfReach(milliseconds(outage));
    live(milliseconds(96));
    live(milliseconds(2000), [this] { arrive(nextPicture()); });
    EXPECT_EQ("", connection_.status.transport_problem) << outage;
  }
}

TEST_F(DatagramsTest, WithoutAWholePictureInTwentyThePicturesComeByTcp) {
  const auto lose_a_part = [this] {
    std::vector<Bytes> cut = nextPicture();
    cut.pop_back();
    arrive(cut);
  };
  live(22 * milliseconds(32), lose_a_part);
  EXPECT_EQ("", connection_.status.transport_problem) << "the last three may still become whole";
  live(milliseconds(32), lose_a_part);
  EXPECT_THAT(connection_.status.transport_problem, testing::HasSubstr("no picture is complete"));
  ASSERT_EQ(PictureTransport::kTcp, connection_.status.transport);
  EXPECT_EQ(kSilentStream, whyGivenUp([this] { live(std::chrono::seconds(1)); }));
}

TEST_F(DatagramsTest, APictureOfTheStreamThatWasOvertakenOnAnyWayIsNotDelivered) {
  auto taken = takePicture(90);
  EXPECT_EQ('F', request());
  arrive(nextPicture());
  arriveByTcp(50, kFrame);
  EXPECT_EQ(1u, counters_.stale_pictures) << "it has waited in TCP";
  answer(version2_frames::makePicture(makeJpeg(60), frameOf(2) + 1));
  EXPECT_EQ(makeJpeg(60), taken.get().picture->jpeg);
  EXPECT_EQ(2u, pictures_.size());
  arrive(nextPicture());
  EXPECT_EQ(2u, counters_.stale_pictures) << "the one that was asked for is newer";
  arrive(nextPicture());
  arriveByTcp(3, frameOf(3));
  EXPECT_EQ(3u, pictures_.size()) << "the same one";
}

TEST_F(DatagramsTest, EachWholePictureIsReportedAtOnceAndAgain) {
  for (unsigned picture = 1; picture < 4; ++picture) {
    arrive(nextPicture());
    const std::vector<Status> statuses = takeStatuses();
    ASSERT_EQ(1u, statuses.size());
    EXPECT_TRUE(statuses[0] == (Status{0, numberOf(picture + 1), 0}));
  }
  wait(milliseconds(49));
  EXPECT_THAT(takeStatuses(), IsEmpty());
  wait(milliseconds(1));
  EXPECT_EQ(1u, takeStatuses().size());
}

TEST_F(DatagramsTest, APartIsAskedForOnceWhenALaterOneShowsThatItIsLost) {
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
  EXPECT_EQ(1u, counters_.lost_datagrams);
  EXPECT_EQ(0u, counters_.lost_pictures);
}

TEST_F(DatagramsTest, TheLastPartIsAskedForWhenNothingComes) {
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

TEST_F(DatagramsTest, APictureThatWasLostWholeIsAskedFor) {
  arrive(nextPicture());
  const std::vector<Bytes> lost = nextPicture();
  takeStatuses();
  const std::vector<Bytes> next = nextPicture();
  arrive(next.front());
  const std::vector<Status> statuses = takeStatuses();
  ASSERT_FALSE(statuses.empty());
  EXPECT_TRUE(statuses[0] == (Status{0, numberOf(2), ~0U})) << "the client does not know how many parts it has";
  for (const Bytes& datagram : lost) {
    arrive(repeated(datagram));
  }
  arrive(next);
  EXPECT_THAT(delivered(), ElementsAre(1, 2, 3));
}

TEST_F(DatagramsTest, AWholePictureDoesNotWaitForThoseBeforeIt) {
  std::vector<Bytes> cut = nextPicture();
  const Bytes late = cut.back();
  cut.pop_back();
  arrive(cut);
  arrive(nextPicture());
  EXPECT_THAT(delivered(), ElementsAre(2));
  EXPECT_EQ(1u, counters_.lost_pictures);
  arrive(late);
  EXPECT_THAT(delivered(), ElementsAre(2));
}

// While a callback runs, for example.
TEST_F(DatagramsTest, APictureThatHasWaitedForTheClientsThreadIsNotDelivered) {
  arrive(nextPicture());
  now_ += milliseconds(150);
  arrive(nextPicture());
  EXPECT_THAT(delivered(), ElementsAre(1));
  EXPECT_EQ(1u, counters_.stale_pictures);
}

}  // namespace
