#include "aibo_driver/rcserver_client.h"

#include <gmock/gmock.h>

#include <atomic>
#include <future>
#include <stdexcept>
#include <thread>

#include "client_fixture.h"

using namespace aibo_driver;
using std::chrono::milliseconds;
using test_pictures::Bytes;
using testing::ElementsAre;

namespace {

class RcServerClientTest : public ClientFixture {};

TEST_F(RcServerClientTest, ConnectsAndReportsIt) {
  EXPECT_EQ(ConnectionState::kDisconnected, client_.status().state);
  client_.start();
  const ScriptedPeer peer = accept();
  ASSERT_TRUE(recorder_.waitForState(ConnectionState::kConnected));
}

TEST_F(RcServerClientTest, AConnectionThatWorksHasNoReasonAndNoAdvice) {
  ScriptedPeer peer = startStream();
  sendUntilDelivered(&peer, test_pictures::make());
  ASSERT_TRUE(recorder_.waitForLog("Connected to 127.0.0.1:" + std::to_string(server_.port())));
  const ConnectionStatus status = client_.status();
  EXPECT_EQ(ConnectionState::kConnected, status.state);
  EXPECT_EQ(1, status.protocol_version);
  EXPECT_EQ("", status.reason);
  EXPECT_EQ("", status.advice);
  EXPECT_EQ(0, recorder_.logged("No connection"));
}

TEST_F(RcServerClientTest, DeliversThePicturesOfTheStreamByteForByteInOrder) {
  ScriptedPeer peer = startStream();
  const auto before = std::chrono::steady_clock::now();
  for (unsigned i = 1; i <= 100; ++i) {
    sendUntilDelivered(&peer, test_pictures::makeNumbered(i));
  }
  ASSERT_TRUE(recorder_.waitForPictures(100));
  const auto pictures = recorder_.pictures();
  auto last_time = before;
  for (unsigned i = 1; i <= 100; ++i) {
    EXPECT_EQ(test_pictures::makeNumbered(i), pictures[i - 1]->jpeg);
    EXPECT_GE(pictures[i - 1]->first_byte_time, last_time);
    last_time = pictures[i - 1]->first_byte_time;
  }
  const ClientStatistics statistics = client_.statistics();
  EXPECT_EQ(100u, statistics.pictures);
  EXPECT_EQ(1u, statistics.connections);
  EXPECT_GT(statistics.bytes_received, 100u * 1000u);
}

TEST_F(RcServerClientTest, APictureOfAnotherSizeOfTheCameraIsDeliveredWithItsSize) {
  ScriptedPeer peer = startStream();
  test_pictures::PictureKind kind;
  kind.width = 104;
  kind.height = 80;
  sendUntilDelivered(&peer, test_pictures::make(kind));
  ASSERT_TRUE(recorder_.waitForPictures(1));
  EXPECT_EQ(104, recorder_.pictures()[0]->width);
  EXPECT_EQ(80, recorder_.pictures()[0]->height);
}

TEST_F(RcServerClientTest, DeliversPicturesThatComeByteByByte) {
  ScriptedPeer peer = startStream();
  const Bytes jpeg = test_pictures::make();
  sendUntilDelivered(client_, [&] {
    for (const std::uint8_t byte : test_pictures::makeReply(jpeg)) {
      peer.send({byte});
    }
  });
  ASSERT_TRUE(recorder_.waitForPictures(1));
  EXPECT_EQ(jpeg, recorder_.pictures()[0]->jpeg);
}

TEST_F(RcServerClientTest, DeliversPicturesCutWithinTheirHeader) {
  ScriptedPeer peer = startStream();
  unsigned count = 0;
  for (std::ptrdiff_t cut = 1; cut <= 6; ++cut) {
    const Bytes reply = test_pictures::makeReply(test_pictures::makeNumbered(++count));
    const Bytes next = test_pictures::makeReply(test_pictures::makeNumbered(++count));
    Bytes second(reply.begin() + cut, reply.end());
    second.insert(second.end(), next.begin(), next.begin() + cut);
    peer.send(Bytes(reply.begin(), reply.begin() + cut));
    peer.send(second);
    peer.send(Bytes(next.begin() + cut, next.end()));
    ASSERT_TRUE(recorder_.waitForPictures(count));
    EXPECT_EQ(test_pictures::makeNumbered(count), recorder_.pictures().back()->jpeg);
  }
}

TEST_F(RcServerClientTest, TheStreamIsStartedAndStoppedOnceHoweverOftenItIsWanted) {
  client_.start();
  ScriptedPeer peer = accept();
  ASSERT_TRUE(recorder_.waitForState(ConnectionState::kConnected));
  client_.setStreaming(true);
  expectCommand(&peer, 'W', 85);
  ASSERT_TRUE(recorder_.waitForStreaming({true}));
  EXPECT_TRUE(client_.streaming());
  client_.setStreaming(true);
  client_.setStreaming(true);
  sendUntilDelivered(&peer, test_pictures::make());
  client_.setStreaming(false);
  expectCommand(&peer, 'W', 85);
  client_.setStreaming(false);
  ASSERT_TRUE(recorder_.waitForStreaming({true, false}));
  EXPECT_FALSE(client_.streaming());
  EXPECT_FALSE(peer.readCommandWithin(milliseconds(50)));
}

TEST_F(RcServerClientTest, RapidTogglesEndWithTheWantedParity) {
  client_.start();
  ScriptedPeer peer = accept();
  ASSERT_TRUE(recorder_.waitForState(ConnectionState::kConnected));
  for (int i = 0; i < 1000; ++i) {
    client_.setStreaming(i % 2 == 0);
  }
  client_.setStreaming(true);
  // Once a call that came after all the toggles is answered from the stream, they have all been carried out.
  auto taken = std::async(std::launch::async, [&] { return client_.takePicture(0, std::chrono::seconds(20)); });
  while (taken.wait_for(milliseconds(10)) != std::future_status::ready) {
    peer.sendPicture(test_pictures::make());
  }
  EXPECT_NE(nullptr, taken.get());
  int toggles = 0;
  while (const auto command = peer.readCommandWithin(milliseconds(0))) {
    EXPECT_EQ('W', command->command);
    ++toggles;
  }
  EXPECT_EQ(1, toggles % 2);
  EXPECT_TRUE(client_.streaming());
}

TEST_F(RcServerClientTest, TheQualityIsThatOfTheNextStart) {
  ScriptedPeer peer = startStream();
  client_.setJpegQuality(42);
  EXPECT_EQ(42, client_.jpegQuality());
  EXPECT_THROW(client_.setJpegQuality(0), InvalidArgumentException);
  EXPECT_THROW(client_.setJpegQuality(101), InvalidArgumentException);
  client_.setStreaming(false);
  peer.readCommand();
  client_.setStreaming(true);
  expectCommand(&peer, 'W', 42);
}

TEST_F(RcServerClientTest, PicturesAfterAStopAreDroppedAndCounted) {
  ScriptedPeer peer = startStream();
  sendUntilDelivered(&peer, test_pictures::makeNumbered(1));
  client_.setStreaming(false);
  expectCommand(&peer, 'W', 85);
  peer.sendPicture(test_pictures::makeNumbered(2));
  EXPECT_TRUE(eventually([&] { return client_.statistics().unexpected_pictures == 1; }));
  client_.setStreaming(true);
  expectCommand(&peer, 'W', 85);
  sendUntilDelivered(&peer, test_pictures::makeNumbered(3));
  EXPECT_EQ(2u, client_.statistics().pictures);
}

TEST_F(RcServerClientTest, AThreadHeldUpDeliversNoStalePictures) {
  std::atomic<bool> held{true};
  Recorder recorder;
  RcServerClient::Callbacks callbacks = recorder.callbacks();
  const auto record = callbacks.on_picture;
  std::atomic<int> delivered{0};
  callbacks.on_picture = [&](const PicturePtr& picture) {
    ++delivered;
    while (held) {
      std::this_thread::sleep_for(milliseconds(1));
    }
    record(picture);
  };
  RcServerClient client(optionsFor(server_), callbacks);
  client.setStreaming(true);
  client.start();
  ScriptedPeer peer = acceptStream();
  peer.sendPicture(test_pictures::makeNumbered(1));
  ASSERT_TRUE(eventually([&] { return delivered > 0; }));
  peer.sendPicture(test_pictures::makeNumbered(2));
  peer.sendPicture(test_pictures::makeNumbered(3));
  std::this_thread::sleep_for(milliseconds(250));  // this wait is what is tested: pictures grow old meanwhile
  held = false;
  EXPECT_TRUE(eventually([&] { return client.statistics().stale_pictures == 2; }));
  unsigned next = 4;
  while (recorder.pictures().size() < 2 && next < 1000) {
    std::this_thread::sleep_for(milliseconds(40));
    peer.sendPicture(test_pictures::makeNumbered(next++));
  }
  const auto pictures = recorder.pictures();
  ASSERT_GE(pictures.size(), 2u);
  EXPECT_EQ(test_pictures::makeNumbered(1), pictures[0]->jpeg);
  EXPECT_NE(test_pictures::makeNumbered(2), pictures[1]->jpeg);
  EXPECT_NE(test_pictures::makeNumbered(3), pictures[1]->jpeg);
}

TEST_F(RcServerClientTest, ACallbackThatThrowsIsLoggedAndTheStreamGoesOn) {
  Recorder recorder;
  RcServerClient::Callbacks callbacks = recorder.callbacks();
  const auto record = callbacks.on_picture;
  callbacks.on_picture = [&](const PicturePtr& picture) {
    record(picture);
    throw std::runtime_error("the disk is full");
  };
  RcServerClient client(optionsFor(server_), callbacks);
  client.setStreaming(true);
  client.start();
  ScriptedPeer peer = acceptStream();
  for (int i = 0; i < 2; ++i) {
    sendUntilDelivered(client, [&] { peer.sendPicture(test_pictures::make()); });
  }
  EXPECT_TRUE(recorder.waitForPictures(2));
  EXPECT_TRUE(eventually([&] { return recorder.logged("on_picture threw an exception: the disk is full") == 2; }));
}

TEST_F(RcServerClientTest, WorksWithoutAnyCallback) {
  RcServerClient client(optionsFor(server_), {});
  client.setStreaming(true);
  client.start();
  ScriptedPeer peer = acceptStream();
  sendUntilDelivered(client, [&] { peer.sendPicture(test_pictures::make()); });
}

TEST_F(RcServerClientTest, StartingTwiceConnectsOnce) {
  client_.start();
  client_.start();
  ScriptedPeer peer = accept();
  EXPECT_FALSE(server_.clientComesWithin(milliseconds(50)));
}

}  // namespace
