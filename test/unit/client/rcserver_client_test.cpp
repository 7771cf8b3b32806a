#include "aibo_client/rcserver_client.h"

#include <gmock/gmock.h>

#include <functional>
#include <future>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "newest_client_fixture.h"

using namespace aibo_client;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

class RcServerClientTest : public ClientFixture {};

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

TEST_F(RcServerClientTest, TellsWhenTheStreamWasSwitchedOnOrOffAlsoByTheEndOfAConnection) {
  ScriptedPeer peer = startStream();
  EXPECT_TRUE(recorder_.waitForStreaming({true}));
  EXPECT_TRUE(client_.streaming());
  client_.setStreaming(false);
  EXPECT_TRUE(recorder_.waitForStreaming({true, false}));
  client_.setStreaming(true);
  EXPECT_TRUE(recorder_.waitForStreaming({true, false, true}));
  server_.vanish();
  peer.close();
  EXPECT_TRUE(recorder_.waitForStreaming({true, false, true, false}));
  EXPECT_FALSE(client_.streaming());
}

TEST_F(RcServerClientTest, DeliversThePicturesOfTheStreamByteForByteInOrder) {
  ScriptedPeer peer = startStream();
  const auto before = std::chrono::steady_clock::now();
  for (unsigned i = 1; i <= 100; ++i) {
    sendUntilDelivered(&peer, test_pictures::makeNumbered(i));
  }
  ASSERT_TRUE(recorder_.waitForPictures(100));
  const ClientStatistics statistics = client_.statistics();  // now: the silence that follows ends the connection
  const auto pictures = recorder_.pictures();
  auto last_time = before;
  for (unsigned i = 1; i <= 100; ++i) {
    EXPECT_EQ(test_pictures::makeNumbered(i), pictures[i - 1]->jpeg);
    EXPECT_GE(pictures[i - 1]->first_byte_time, last_time);
    last_time = pictures[i - 1]->first_byte_time;
  }
  EXPECT_EQ(100u, statistics.pictures);
  EXPECT_EQ(1u, statistics.connections);
  EXPECT_GT(statistics.bytes_received, 100u * 1000u);
}

TEST_F(RcServerClientTest, ACallbackThatThrowsIsLoggedAndTheStreamGoesOn) {
  Recorder recorder;
  Callbacks callbacks = recorder.callbacks();
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

TEST_F(RcServerClientTest, WaitsForTheConnection) {
  EXPECT_EQ(ConnectionState::kDisconnected, client_.status().state);
  client_.start();
  auto waiting = std::async(std::launch::async, [&] { client_.waitForConnection(seconds(20)); });
  ScriptedPeer peer = accept();
  waiting.get();
  EXPECT_EQ(ConnectionState::kConnected, client_.status().state);
}

TEST_F(RcServerClientTest, SaysWhyThereIsStillNoConnection) {
  server_.vanish();
  client_.start();
  ASSERT_TRUE(recorder_.waitForReason("refused"));
  EXPECT_THAT(complaintOf<NetworkException>([&] { client_.waitForConnection(milliseconds(1)); }),
              ::testing::HasSubstr("refused"));
  EXPECT_THROW(client_.waitForConnection(milliseconds(0)), InvalidArgumentException);
}

TEST_F(RcServerClientTest, StoppingEndsTheWaitForTheConnection) {
  client_.start();
  auto waiting = std::async(std::launch::async, [&] { client_.waitForConnection(seconds(60)); });
  client_.stop();
  EXPECT_THROW(waiting.get(), StoppedException);
}

TEST_F(RcServerClientTest, StartingTwiceConnectsOnce) {
  client_.start();
  client_.start();
  ScriptedPeer peer = accept();
  EXPECT_FALSE(server_.clientComesWithin(milliseconds(50)));
}

TEST_F(RcServerClientTest, WhatComesTogetherWithTheAnswerAboutTheVersionIsRead) {
  client_.start();
  ScriptedPeer peer = server_.accept();
  expectCommand(&peer, 'X', 2);
  peer.send({'e', 0, 0, 0, 'j', 1, 0, 0});
  EXPECT_TRUE(recorder_.waitForLog("an answer to no request: 'j'"));
}

class ClientSettingsTest : public NewestClientFixture {};

TEST_F(ClientSettingsTest, EachSettingReachesTheRobot) {
  ColorTable table;
  table.segments[0] = ColorRange{1, 2, 3, 4};
  CameraSettings camera;
  camera.white_balance = camera.shutter_speed = 1;
  camera.gain = 3;
  camera.auto_exposure = true;
  client().setStreaming(true);
  client().setJpegQuality(60);
  client().setStreamFormat({Resolution::kLow, 3});
  client().setCameraSettings(camera);
  client().setColorDetection({true, 4, true});
  client().setColorTable(5, std::make_shared<ColorTable>(table));
  client().setMicrophone({true, 1, 8000});
  EXPECT_EQ(60, client().jpegQuality());
  EXPECT_TRUE(client().streamFormat() == (StreamFormat{Resolution::kLow, 3}));
  ScriptedPeer peer = connectVersion2("F W G Z A");
  const auto expect = [&peer](const std::vector<std::string>& requests) {
    for (const std::string& each : requests) {
      EXPECT_EQ(each, version2_frames::textOf(peer.readRequest(), 8));
    }
  };
  expect({"G 1 1", "G 2 3", "G 3 1", "G 4 1", "G 5 0", "W 60 1 2 0 3", "Z 2 5 0 0 0 1 2 3 4", "Z 1 0 4 1 0",
          "A 1 1 1 31 64"});
  table.segments[0]->cr_min = 2;
  client().setColorTable(5, std::make_shared<ColorTable>(table));
  expect({"Z 2 5 0 0 0 2 2 3 4"});
  client().setColorTable(5, nullptr);
  expect({"Z 2 5 0 0 0 128 128 128 128"});
}

TEST_F(ClientSettingsTest, ASettingThatCannotBeIsRefused) {
  for (const int quality : {0, 101}) {
    EXPECT_THROW(client().setJpegQuality(quality), InvalidArgumentException);
  }
  for (const int every_nth_image : {0, 65536}) {
    EXPECT_THROW(client().setStreamFormat({Resolution::kHigh, every_nth_image}), InvalidArgumentException);
    EXPECT_THROW(client().setColorDetection({true, every_nth_image, false}), InvalidArgumentException);
  }
  for (const int channel : {-1, kMostColorChannels}) {
    EXPECT_THROW(client().setColorTable(channel, nullptr), InvalidArgumentException);
  }
  ColorTable table;
  table.segments[0] = ColorRange{2, 1, 3, 4};
  EXPECT_THROW(client().setColorTable(0, std::make_shared<ColorTable>(table)), InvalidArgumentException);
  for (const auto setting : {&CameraSettings::white_balance, &CameraSettings::gain, &CameraSettings::shutter_speed}) {
    for (const int value : {0, 4}) {
      CameraSettings camera;
      camera.*setting = value;
      EXPECT_THROW(client().setCameraSettings(camera), InvalidArgumentException);
    }
  }
}

class CallTimesTest : public NewestClientFixture {};

TEST_F(CallTimesTest, EachCallWaitsAsLongAsItIsTold) {
  const std::vector<std::function<void(milliseconds)>> calls = {
      [this](milliseconds time) { client().takePicture(50, time); },
      [this](milliseconds time) { client().setMotors(true, time); },
      [this](milliseconds time) { client().hold({}, time); },
      [this](milliseconds time) { client().takePosture(Posture::kStand, time); },
      [this](milliseconds time) { client().playMotion("NOD.MTN", 1, time); },
      [this](milliseconds time) { client().stopMotion("NOD.MTN", time); },
      [this](milliseconds time) { client().uploadMotion("NOD.MTN", std::vector<std::uint8_t>(9), time); },
      [this](milliseconds time) { client().deleteMotion("NOD.MTN", time); },
      [this](milliseconds time) { client().listMotions(time); },
      [this](milliseconds time) { client().takePictureOnRobot(50, time); },
      [this](milliseconds time) { client().listPictures(time); },
      [this](milliseconds time) { client().fetchPicture("AIBO0001.JPG", time); },
      [this](milliseconds time) { client().deletePicture("AIBO0001.JPG", time); },
      [this](milliseconds time) {
        client().playSamples(0, {1, 2, 3}, false, time);
      },
      [this](milliseconds time) { client().stopSound(time); },
      [this](milliseconds time) { client().setVolume(1, time); },
      [this](milliseconds time) { client().shutDownRobot(time); },
      [this](milliseconds time) { client().rebootRobot(time); }};
  const ScriptedPeer silent = connectVersion2("F W J V T O I E S P U D N M Y A Q R");
  for (std::size_t i = 0; i < calls.size(); ++i) {
    const milliseconds time(10 + static_cast<int>(i));
    EXPECT_THAT(complaintOf<TimeoutException>([&] { calls[i](time); }),
                ::testing::HasSubstr(" within " + std::to_string(time.count()) + " ms"))
        << i;
  }
}

}  // namespace
