// Calls that wait: how they end when there is no connection, and what their exceptions say.
#include <gmock/gmock.h>

#include <functional>
#include <future>

#include "client_fixture.h"

using namespace aibo_client;
using test_support::kSafetyNet;
using testing::AllOf;
using testing::HasSubstr;

namespace {

struct Failure {
  FaultKind kind;
  bool was_sent;
  std::string text;
};

class ACallThatWaits : public ClientFixture {
 protected:
  std::future<PicturePtr> takeInBackground() {
    return std::async(std::launch::async, [this] { return client_.takePicture(40, kSafetyNet); });
  }

  static Failure failureOf(const std::function<void()>& call) {
    try {
      call();
    } catch (const NetworkException& error) {
      return {error.kind(), error.wasSent(), error.what()};
    }
    return {FaultKind::kInternal, false, "no failure"};
  }
};

TEST_F(ACallThatWaits, FailsAtOnceWithoutAConnectionAndSaysWhatToCheck) {
  const auto fail = [this] { return failureOf([this] { client_.takePicture(0, kSafetyNet); }); };
  EXPECT_THAT(fail().text, HasSubstr("has not been started"));
  EXPECT_EQ(FaultKind::kNone, fail().kind);
  server_.vanish();
  client_.start();
  ASSERT_TRUE(recorder_.waitForReason("refused"));
  EXPECT_THAT(fail().text, AllOf(HasSubstr("refused the connection"), HasSubstr("Is the RCServer running there")));
  EXPECT_EQ(FaultKind::kRefused, fail().kind);
  EXPECT_EQ(FaultKind::kRefused, client_.status().fault);
  EXPECT_FALSE(fail().was_sent);
  server_.listen();
  const ScriptedPeer peer = accept();
  EXPECT_TRUE(eventually([this] { return client_.status().fault == FaultKind::kNone; }));
}

TEST_F(ACallThatWaits, FailsWithItsConnectionAndNamesTheReason) {
  const struct {
    std::function<void(ScriptedPeer*)> act;
    FaultKind kind;
    const char* text;
  } rows[] = {
      {[](ScriptedPeer* peer) { peer->close(); }, FaultKind::kClosed, "closed the connection. Was the robot"},
      {[](ScriptedPeer* peer) { peer->send({'?'}); }, FaultKind::kProtocol, "does not speak the RCServer's protocol"},
  };
  for (const auto& row : rows) {
    ScriptedPeer peer = connectVersion1();
    EXPECT_TRUE(eventually([this] { return client_.status().state == ConnectionState::kConnected; }));
    auto taken = takeInBackground();
    expectCommand(&peer, 'F', 40);
    row.act(&peer);
    const Failure failure = failureOf([&taken] { taken.get(); });
    EXPECT_EQ(row.kind, failure.kind);
    EXPECT_TRUE(failure.was_sent);
    EXPECT_THAT(failure.text, HasSubstr(row.text));
  }
  EXPECT_EQ(1u, client_.statistics().protocol_errors);
  EXPECT_EQ(0u, client_.statistics().stalls);
}

TEST_F(ACallThatWaits, HasNoFaultOfItsOwnWhenItsTimeIsOverButItsConnectionHas) {
  const ScriptedPeer peer = connectVersion1();
  EXPECT_EQ(FaultKind::kNone, failureOf([this] { client_.takePicture(40, std::chrono::milliseconds(100)); }).kind);
  EXPECT_TRUE(recorder_.waitForReason("did not answer the request to take a picture within 100 ms"));
  EXPECT_EQ(FaultKind::kSilent, client_.status().fault);
  EXPECT_EQ(1u, client_.statistics().stalls);
}

TEST_F(ACallThatWaits, IsRefusedFromACallbackInsteadOfWaitingForItself) {
  std::promise<std::string> complaint;
  RcServerClient* self = nullptr;
  Callbacks callbacks;
  callbacks.on_picture = [&](const PicturePtr&) {
    EXPECT_THROW(self->waitForConnection(kSafetyNet), Exception);
    complaint.set_value(complaintOf<Exception>([&] { self->takePicture(0, kSafetyNet); }));
  };
  RcServerClient client(optionsFor(server_), callbacks);
  self = &client;
  client.setStreaming(true);
  client.start();
  ScriptedPeer peer = acceptStream();
  sendUntilDelivered(client, [&] { peer.sendPicture(test_pictures::make()); });
  EXPECT_THAT(complaint.get_future().get(), HasSubstr("cannot be called from a callback"));
}

}  // namespace
