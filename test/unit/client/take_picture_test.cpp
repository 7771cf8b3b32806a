#include <gmock/gmock.h>

#include <future>
#include <optional>

#include "client_fixture.h"

using namespace aibo_client;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;

namespace {

class TakePictureTest : public ClientFixture {
 protected:
  ScriptedPeer connect() {
    client_.start();
    ScriptedPeer peer = accept();
    EXPECT_TRUE(recorder_.waitForState(ConnectionState::kConnected));
    return peer;
  }

  std::future<PicturePtr> takeInBackground(int quality, milliseconds timeout = seconds(20)) {
    return std::async(std::launch::async, [this, quality, timeout] { return client_.takePicture(quality, timeout); });
  }
};

TEST_F(TakePictureTest, WithoutAConnectionItFailsAtOnceAndSaysWhatToCheck) {
  EXPECT_THAT(complaintOf<NetworkException>([&] { client_.takePicture(0, seconds(20)); }),
              HasSubstr("has not been started"));
  server_.vanish();
  client_.start();
  ASSERT_TRUE(recorder_.waitForReason("refused"));
  const std::string complaint = complaintOf<NetworkException>([&] { client_.takePicture(0, seconds(20)); });
  EXPECT_THAT(complaint, HasSubstr("refused the connection"));
  EXPECT_THAT(complaint, HasSubstr("Is the RCServer running there"));
}

TEST_F(TakePictureTest, AConnectionThatBreaksWhileWaitingSaysWhatToCheck) {
  ScriptedPeer peer = connect();
  auto taken = takeInBackground(40);
  expectCommand(&peer, 'F', 40);
  peer.send({'e', 0});
  peer.close();
  EXPECT_THAT(complaintOf<NetworkException>([&] { taken.get(); }), HasSubstr("closed the connection. Was the robot"));
}

TEST_F(TakePictureTest, ARequestIsNotRepeatedAfterAReconnect) {
  ScriptedPeer peer = connect();
  auto taken = takeInBackground(40);
  expectCommand(&peer, 'F', 40);
  peer.close();
  EXPECT_THROW(taken.get(), NetworkException);
  ScriptedPeer next = accept();
  EXPECT_FALSE(next.readCommandWithin(milliseconds(50)));
}

TEST_F(TakePictureTest, APictureOfTheStreamThatBeganBeforeTheCallIsNotItsAnswer) {
  ScriptedPeer peer = startStream();
  const auto reply = test_pictures::makeReply(test_pictures::makeNumbered(1));
  const std::uint64_t begun = client_.statistics().bytes_received + 100;
  peer.send({reply.begin(), reply.begin() + 100});
  ASSERT_TRUE(eventually([&] { return client_.statistics().bytes_received >= begun; }));
  int quality = 0;
  const auto take = [&] { return client_.takePicture(40, seconds(20), &quality); };
  auto taken = std::async(std::launch::async, take);
  EXPECT_FALSE(peer.readCommandWithin(milliseconds(50))) << "the stream will answer";
  peer.send({reply.begin() + 100, reply.end()});
  EXPECT_TRUE(eventually([&] {
    peer.sendPicture(test_pictures::makeNumbered(2));
    return taken.wait_for(milliseconds(1)) == std::future_status::ready;
  }));
  EXPECT_EQ(test_pictures::makeNumbered(2), taken.get()->jpeg);
  EXPECT_EQ(73, quality) << "the stream's";
  client_.setStreaming(false);
  expectCommand(&peer, 'W', 73);
  taken = std::async(std::launch::async, take);
  expectCommand(&peer, 'F', 40);
  peer.sendPicture(test_pictures::makeNumbered(3));
  EXPECT_EQ(test_pictures::makeNumbered(3), taken.get()->jpeg);
  EXPECT_EQ(0, quality) << "the stream has been switched off";
}

TEST_F(TakePictureTest, QualityAndTimeoutAreChecked) {
  EXPECT_THROW(client_.takePicture(-1, seconds(1)), InvalidArgumentException);
  EXPECT_THROW(client_.takePicture(101, seconds(1)), InvalidArgumentException);
  EXPECT_THROW(client_.takePicture(50, milliseconds(0)), InvalidArgumentException);
  EXPECT_THROW(client_.takePicture(50, milliseconds::max()), InvalidArgumentException);
}

TEST_F(TakePictureTest, ACallFromACallbackIsRefusedInsteadOfWaitingForItself) {
  std::promise<std::string> complaint;
  RcServerClient* self = nullptr;
  Callbacks callbacks;
  callbacks.on_picture = [&](const PicturePtr&) {
    EXPECT_THROW(self->waitForConnection(seconds(20)), Exception);
    complaint.set_value(complaintOf<Exception>([&] { self->takePicture(0, seconds(20)); }));
  };
  RcServerClient client(optionsFor(server_), callbacks);
  self = &client;
  client.setStreaming(true);
  client.start();
  ScriptedPeer peer = acceptStream();
  sendUntilDelivered(client, [&] { peer.sendPicture(test_pictures::make()); });
  EXPECT_THAT(complaint.get_future().get(), HasSubstr("cannot be called from a callback"));
}

class FaultKindTest : public TakePictureTest {
 protected:
  template <typename Call>
  static FaultKind kindOf(const Call& call, std::optional<bool> was_sent = std::nullopt) {
    try {
      call();
    } catch (const NetworkException& error) {
      EXPECT_EQ(was_sent.value_or(error.wasSent()), error.wasSent());
      return error.kind();
    }
    ADD_FAILURE() << "no NetworkException";
    return FaultKind::kInternal;
  }

  FaultKind kindOfCall() {
    return kindOf([this] { client_.takePicture(0, seconds(20)); }, false);
  }

  /// The kind of fault that ends a waiting call when the server does this.
  template <typename Act>
  FaultKind kindOfWaitingCall(const Act& act) {
    ScriptedPeer peer = connect();
    auto taken = takeInBackground(40);
    expectCommand(&peer, 'F', 40);
    act(&peer);
    return kindOf([&taken] { taken.get(); }, true);
  }
};

TEST_F(FaultKindTest, BeforeTheFirstAttemptNothingHasFailed) {
  EXPECT_EQ(FaultKind::kNone, kindOfCall());
  EXPECT_EQ(FaultKind::kNone, client_.status().fault);
}

TEST_F(FaultKindTest, WithoutAConnectionACallAndTheStatusNameTheReason) {
  server_.vanish();
  client_.start();
  ASSERT_TRUE(recorder_.waitForReason("refused"));
  EXPECT_EQ(FaultKind::kRefused, kindOfCall());
  EXPECT_EQ(FaultKind::kRefused, client_.status().fault);
  server_.listen();
  ScriptedPeer peer = accept();
  ASSERT_TRUE(recorder_.waitForLog("Connected to"));
  EXPECT_TRUE(eventually([this] { return client_.status().fault == FaultKind::kNone; }));
}

TEST_F(FaultKindTest, AConnectionThatBreaksWhileACallWaitsNamesTheReason) {
  EXPECT_EQ(FaultKind::kClosed, kindOfWaitingCall([](ScriptedPeer* peer) { peer->close(); }));
}

TEST_F(FaultKindTest, AProtocolErrorNamesItself) {
  EXPECT_EQ(FaultKind::kProtocol, kindOfWaitingCall([](ScriptedPeer* peer) { peer->send({'?'}); }));
}

TEST_F(FaultKindTest, ACallThatTimesOutHasNoFaultButTheConnectionThatEndsBecauseOfItHas) {
  const ScriptedPeer peer = connect();
  EXPECT_EQ(FaultKind::kNone, kindOf([this] { client_.takePicture(40, milliseconds(100)); }));
  EXPECT_TRUE(recorder_.waitForReason("sent no whole picture within 100 ms"));
  EXPECT_EQ(FaultKind::kSilent, client_.status().fault);
}

}  // namespace
