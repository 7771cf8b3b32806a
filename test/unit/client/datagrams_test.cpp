// Pictures by UDP: what the client asks for, which pictures it delivers, and when it goes back to TCP.
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <future>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "client_fixture.h"
#include "datagrams_fixture.h"
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
 public:
  DatagramsTest() : DatagramsFixture("F W B") {
    wish_.transport = PictureTransport::kUdp;
    startStream();
  }
};

class DatagramOrderTest : public DatagramsFixture {
 public:
  DatagramOrderTest() : DatagramsFixture("F W B") {
    wish_.transport = PictureTransport::kUdp;
    wish_.streaming = true;
    wish_.datagram_port = 0x1234;
    EXPECT_EQ('B', request()) << "before the stream";
  }
};

TEST_F(DatagramOrderTest, NamesThePortOnceUntilItChanges) {
  EXPECT_EQ(Bytes({0x12, 0x34}), payload_);
  EXPECT_EQ('W', request());
  EXPECT_EQ(0, request());
  wish_.datagram_port = 0;
  EXPECT_EQ('B', request());
  EXPECT_EQ(Bytes({0, 0}), payload_);
  answer(payload_);
  EXPECT_EQ(PictureTransport::kTcp, connection_.transport);
}

TEST_F(DatagramOrderTest, ThatIsRefusedMeansTcp) {
  refuse("no endpoint");
  EXPECT_EQ("it refused to: no endpoint", connection_.transport_problem);
  EXPECT_FALSE(connection_.lets_no_datagram_through) << "over the next connection it may agree";
  EXPECT_EQ(1u, counters_.refusals);
  wish_.datagram_port = 0;
  answer();
  arriveByTcp(1, frameOf(1));
  EXPECT_EQ(1u, pictures_.size());
}

TEST_F(DatagramsTest, APictureIsDeliveredWhenItIsWholeInAnyOrderOfItsParts) {
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
  EXPECT_EQ(datagrams.size(), counters_.reordered_datagrams);
  EXPECT_EQ(datagrams.size() + 1, counters_.datagrams);
}

TEST_F(DatagramsTest, APictureThatHasLostAPartDelaysNoOtherAndIsNotDeliveredLater) {
  std::vector<Bytes> cut = nextPicture();
  const Bytes late = cut.back();
  cut.pop_back();
  arrive(cut);
  arrive(nextPicture());
  arrive(late);
  EXPECT_THAT(delivered(), ElementsAre(2));
  EXPECT_EQ(1u, counters_.lost_pictures);
  EXPECT_EQ(1u, counters_.reordered_datagrams);
}

TEST_F(DatagramsTest, DatagramsThatComeTwiceAreCountedAndDoNoHarm) {
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
  const std::vector<Bytes> picture = nextPicture();
  const auto changed = [](Bytes datagram, std::size_t at, int bits) {
    datagram[at] ^= static_cast<std::uint8_t>(bits);
    return datagram;
  };
  const std::pair<std::string, Bytes> rows[] = {
      {"empty", {}},
      {"too large", Bytes(1400, 'b')},
      {"a header alone", Bytes(picture[0].begin(), picture[0].begin() + 32)},
      {"cut", Bytes(picture[0].begin(), picture[0].end() - 1)},
      {"a datagram of the far future", changed(picture[0], 4, 0x7f)},
      {"a picture of the far future", changed(picture[0], 8, 1)},
  };
  arrive(picture[0]);
  for (const auto& [name, datagram] : rows) {
    const std::uint64_t before = counters_.bad_datagrams;
    arrive(datagram);
    EXPECT_EQ(before + 1, counters_.bad_datagrams) << name;
  }
  arrive(picture);
  EXPECT_THAT(delivered(), ElementsAre(1));
  EXPECT_THAT(repliesOf('l'), IsEmpty());
  EXPECT_EQ(1, logged("that is dropped"));
}

TEST_F(DatagramsTest, APartThatContradictsTheOthersIsNoneOfThePicture) {
  const std::vector<Bytes> picture = nextPicture();
  Bytes contradiction = picture[1];
  contradiction[23] ^= 1;  // its frame is another one
  arrive(picture[0]);
  arrive(contradiction);
  EXPECT_EQ(1u, counters_.bad_datagrams);
  arrive(picture);
  EXPECT_THAT(delivered(), ElementsAre(1));
}

// Of pictures that the robot never sent, in its name: whole ones that are no JPEGs, and incomplete ones, whose numbers
// are far ahead, or not so far.
TEST_F(DatagramsTest, ForgedOnesDoNotStopTheStream) {
  live(std::chrono::seconds(5), [this] {
    for (const unsigned picture : {60000U, 60001U, picture_ + 40, picture_ + 65, 100U}) {
      unsigned sequence = picture + 1;
      arrive(test_support::makeDatagrams(Bytes(100, 'x'), picture, kFrame, &sequence));
      std::vector<Bytes> incomplete = test_support::makeDatagrams(makeJpeg(7), picture, kFrame, &sequence);
      incomplete.pop_back();
      arrive(incomplete);
    }
    arrive(nextPicture());
  });
  EXPECT_EQ("", connection_.transport_problem);
  EXPECT_GE(pictures_.size(), picture_ * 9 / 10);
  EXPECT_GE(repliesOf('a').size(), picture_ * 9 / 10) << "the robot waits for them";
}

TEST_F(DatagramsTest, AFrameNumberOfTheFutureIsNotBelieved) {
  arrive(nextPicture());
  unsigned sequence = sequence_;
  arrive(test_support::makeDatagrams(makeJpeg(1), picture_, kFrame + 20, &sequence));
  EXPECT_THAT(delivered(), ElementsAre(1));
  nextPicture();  // its number is the forged one's
  arrive(nextPicture());
  EXPECT_THAT(delivered(), ElementsAre(1, 3));
}

// Pictures of the robot's, sent again with other numbers, twice a second.
TEST_F(DatagramsTest, AForgedGoodPictureCostsAFewPicturesAtMost) {
  live(std::chrono::seconds(5), [this] {
    arrive(nextPicture());
    for (const unsigned ahead : {60000U, 60001U, 65U, 40U, 20U, 3U}) {
      unsigned sequence = picture_ + ahead;
      if (picture_ % 15 == 0) {
        arrive(test_support::makeDatagrams(makeJpeg(1), picture_ + ahead, frameOf(picture_ + 1), &sequence));
      }
    }
  });
  EXPECT_EQ("", connection_.transport_problem);
  EXPECT_GE(pictures_.size(), picture_ * 7 / 10);
  EXPECT_LT(0u, counters_.bad_datagrams);
}

TEST_F(DatagramsTest, OnlyGoodPicturesPostponeTheReturnToTcp) {
  live(milliseconds(1500),
       [this] { arrive(test_support::makeDatagrams(Bytes(100, 'x'), picture_++, kFrame, &sequence_, false)); });
  EXPECT_THAT(connection_.transport_problem, HasSubstr("datagrams come, but no good picture"));
  EXPECT_EQ(PictureTransport::kTcp, connection_.transport);
}

// A computer that was held up finds some pictures in the system's buffer, which had no room for the ones after them.
TEST_F(DatagramsTest, AJumpInTheNumbersOfPicturesIsBelievedSoon) {
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
  arrive(nextPicture());
  for (int i = 0; i < 25; ++i) {
    nextPicture();
  }
  beOutOfReach(milliseconds(800));
  arrive(nextPicture());
  EXPECT_THAT(delivered(), ElementsAre(1, 27));
}

TEST_F(DatagramsTest, WithoutADatagramForOneSecondThePicturesComeByTcp) {
  const auto send_by_tcp = [this] { push('t', version2_frames::makeTelemetry(5000, {})); };  // hides nothing
  live(milliseconds(960), send_by_tcp);
  EXPECT_EQ("", connection_.transport_problem);
  live(milliseconds(300), send_by_tcp);
  EXPECT_THAT(connection_.transport_problem, HasSubstr("no datagram has come for 1 s, while TCP works"));
  EXPECT_EQ(PictureTransport::kTcp, connection_.transport);
  EXPECT_TRUE(connection_.lets_no_datagram_through);
  EXPECT_EQ(1, logged("by TCP, not by UDP"));
  arriveByTcp(1, frameOf(1000));
  EXPECT_EQ(1u, pictures_.size());
}

TEST_F(DatagramsTest, DatagramsThatStopComingDoNotMeanThatNoneGetsThrough) {
  live(milliseconds(320), [this] { arrive(nextPicture()); });
  live(milliseconds(1300));
  EXPECT_NE("", connection_.transport_problem);
  EXPECT_FALSE(connection_.lets_no_datagram_through);
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
    EXPECT_EQ("", connection_.transport_problem) << outage;
  }
}

TEST_F(DatagramsTest, WithoutAWholePictureInTwentyThePicturesComeByTcpWhereSilenceIsAFault) {
  live(std::chrono::seconds(1), [this] { arrive(nextCut()); });
  EXPECT_THAT(connection_.transport_problem, HasSubstr("no picture is complete"));
  EXPECT_FALSE(connection_.lets_no_datagram_through);
  ASSERT_EQ(PictureTransport::kTcp, connection_.transport);
  EXPECT_EQ(kSilentStream, whyGivenUp([this] { live(std::chrono::seconds(1)); }));
}

TEST_F(DatagramsTest, AWholePictureNowAndThenIsEnough) {
  live(std::chrono::seconds(5), [this] { arrive(picture_ % 4 == 0 ? nextPicture() : nextCut()); });
  EXPECT_EQ("", connection_.transport_problem);
  EXPECT_NEAR(3 * (picture_ / 4), static_cast<double>(counters_.lost_pictures), 3);
  EXPECT_NEAR(3 * (picture_ / 4), static_cast<double>(counters_.lost_datagrams), 8)
      << "the last 64 are not counted yet";
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

TEST_F(DatagramsTest, EachPictureIsAcknowledgedWhenItsLastPartOrALaterOneHasCome) {
  arrive(nextPicture());
  EXPECT_THAT(repliesOf('a'), ElementsAre(Bytes({'a', 0, 0, 0, 0, 0, 0, 0})));
  std::vector<Bytes> picture = nextPicture();
  arrive(picture.back());
  arrive(picture.front());
  EXPECT_EQ(2u, repliesOf('a').size());
  EXPECT_EQ(Bytes({'a', 0, 0, 0, 0, 0, 0, 1}), repliesOf('a').back());
  arrive(nextCut());
  EXPECT_EQ(2u, repliesOf('a').size());
  arrive(nextPicture().front());
  EXPECT_EQ(Bytes({'a', 0, 0, 0, 0, 0, 0, 2}), repliesOf('a').back()) << "its last part will not come any more";
}

TEST_F(DatagramsTest, AnyDatagramOfAGroupWithParityMayBeLost) {
  constexpr std::ptrdiff_t kDatagrams = 7;
  for (std::ptrdiff_t lost = 0; lost < kDatagrams; ++lost) {
    std::vector<Bytes> picture = nextPicture(true);
    ASSERT_EQ(kDatagrams, static_cast<std::ptrdiff_t>(picture.size()));
    picture.erase(picture.begin() + lost);
    pass(milliseconds(32));
    arrive(picture);
    ASSERT_EQ(delivered().size(), picture_) << lost;
    EXPECT_EQ(delivered().back(), picture_) << lost;
  }
  EXPECT_EQ(kDatagrams - 1, static_cast<std::ptrdiff_t>(counters_.repaired_datagrams))
      << "a lost parity needs no repair";
  EXPECT_EQ(0u, counters_.lost_pictures);
  EXPECT_EQ(0u, counters_.bad_datagrams);
}

TEST_F(DatagramsTest, EachGroupOfALargePictureMayLoseADatagram) {
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

TEST_F(DatagramsTest, TheParityOfTheLastPartsAcknowledgesTooAndThatIsRepeated) {
  std::vector<Bytes> picture = nextPicture(true);
  const Bytes parity = picture.back();
  picture.resize(picture.size() - 2);  // without the last part
  arrive(picture);
  EXPECT_THAT(repliesOf('a'), IsEmpty());
  arrive(parity);
  EXPECT_EQ(1u, repliesOf('a').size());
  EXPECT_THAT(delivered(), ElementsAre(1));
  arrive(nextPicture().front());
  EXPECT_EQ(2u, repliesOf('a').size());
  EXPECT_EQ(Bytes({'a', 0, 0, 0, 0, 0, 0, 0}), repliesOf('a').back());
}

TEST_F(DatagramsTest, DatagramsAfterTheReturnToTcpAreIgnored) {
  arrive(nextPicture());
  wish_.datagram_port = 0;
  answer();
  arrive(nextPicture());
  EXPECT_THAT(delivered(), ElementsAre(1));
}

// ------------------------------------------------------------------------------------------------ with sockets

class DatagramClientTest : public ClientFixture {
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
  client_.setPictureTransport(PictureTransport::kUdp);
  client_.setStreaming(true);
  ScriptedPeer peer = connectVersion2("F W B");
  const int port = startStream(&peer);
  ASSERT_GT(port, 0);
  test_support::UdpSocket stranger("127.0.0.2");
  test_support::UdpSocket robot;
  unsigned sequence = 0;
  const std::vector<Bytes> forged = test_support::makeDatagrams(makeJpeg(99), 0, 100, &sequence);
  for (const Bytes& datagram : forged) {
    stranger.send(port, datagram);
  }
  EXPECT_TRUE(eventually([&] { return client_.statistics().foreign_datagrams == forged.size(); }));
  sendUntilDelivered(client_, [&] { sendPicture(&robot, port); });
  ASSERT_FALSE(recorder_.pictures().empty());
  EXPECT_NE(makeJpeg(99), recorder_.pictures().front()->jpeg);
  EXPECT_EQ(PictureTransport::kUdp, client_.status().transport);
  std::optional<Bytes> reply;
  EXPECT_TRUE(eventually([&] { return (reply = robot.next()).has_value(); }));
  EXPECT_EQ(Bytes({'a', 0, 0, 0, 0, 0, 0, 0}), reply) << "the first picture has come";
  EXPECT_FALSE(stranger.next());
}

TEST_F(DatagramClientTest, WithoutAFreeSocketPicturesComeByTcpAndTheReasonIsTold) {
  client_.setStreaming(true);
  ScriptedPeer peer = connectVersion2("F W B");
  confirm(&peer, peer.readRequest());
  rlimit usual{};
  ::getrlimit(RLIMIT_NOFILE, &usual);
  rlimit exhausted = usual;
  const int lowest_free = ::dup(STDERR_FILENO);
  ::close(lowest_free);
  exhausted.rlim_cur = static_cast<rlim_t>(lowest_free);
  ::setrlimit(RLIMIT_NOFILE, &exhausted);
  client_.setPictureTransport(PictureTransport::kUdp);
  EXPECT_TRUE(eventually([&] { return client_.status().transport_problem == "this computer has no free socket"; }));
  ::setrlimit(RLIMIT_NOFILE, &usual);
  EXPECT_EQ(PictureTransport::kTcp, client_.status().transport);
  client_.setPictureTransport(PictureTransport::kTcp);
  client_.setPictureTransport(PictureTransport::kUdp);
  EXPECT_GT(portIn(peer.readRequest()), 0);
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

TEST_F(DatagramClientTest, AServerWithoutTheRequestSendsByTcpAndTheReasonIsTold) {
  client_.setPictureTransport(PictureTransport::kUdp);
  client_.setStreaming(true);
  ScriptedPeer peer = connectVersion2("F W");
  EXPECT_EQ('W', peer.readRequest().header.kind);
  EXPECT_TRUE(recorder_.waitForStatus([](const ConnectionStatus& status) {
    return status.state == ConnectionState::kConnected &&
           status.transport_problem.find("no request for it") != std::string::npos;
  }));
  EXPECT_EQ(1, recorder_.logged("by TCP, not by UDP"));
}

TEST_F(DatagramClientTest, TheTransportCanBeChangedWhileTheStreamRuns) {
  client_.setStreaming(true);
  ScriptedPeer peer = connectVersion2("F W B");
  confirm(&peer, peer.readRequest());
  for (const PictureTransport way : {PictureTransport::kUdp, PictureTransport::kTcp}) {
    client_.setPictureTransport(way);
    const version2_frames::Frame request = peer.readRequest();
    EXPECT_EQ('B', request.header.kind);
    EXPECT_EQ(way == PictureTransport::kUdp, portIn(request) != 0);
    EXPECT_TRUE(recorder_.waitForStatus([way](const auto& status) { return status.wanted_transport == way; }));
    confirm(&peer, request);
    EXPECT_TRUE(eventually([&] { return client_.status().transport == way; }));
  }
}

TEST_F(DatagramClientTest, WhereNoDatagramEverCameTheNextConnectionBeginsWithATest) {
  client_.setPictureTransport(PictureTransport::kUdp);
  client_.setStreaming(true);
  {
    ScriptedPeer peer = connectVersion2("F W B");
    startStream(&peer);
    EXPECT_EQ("B 0 0 0", version2_frames::textOf(peer.readRequest())) << "after 1 s";
    EXPECT_THAT(client_.status().transport_problem, HasSubstr("no datagram"));
  }
  {
    ScriptedPeer peer = connectVersion2("F W B X");
    EXPECT_EQ(1, peer.readRequest().payload.at(2)) << "it is to send a test";
  }
  {
    ScriptedPeer peer = connectVersion2("F W B");
    EXPECT_EQ('W', peer.readRequest().header.kind) << "it cannot test";
    client_.setPictureTransport(PictureTransport::kTcp);
    client_.setPictureTransport(PictureTransport::kUdp);  // before the client's thread has seen the other one
    EXPECT_GT(portIn(peer.readRequest()), 0) << "the user asks for it";
  }
}

// The callback takes longer than StallDetector::kStallLimit, so what comes meanwhile is no longer fresh.
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
    for (const PicturePtr& picture : recorder.pictures()) {
      EXPECT_NE(picture->jpeg, makeJpeg(waits));
    }
  }
}

}  // namespace
