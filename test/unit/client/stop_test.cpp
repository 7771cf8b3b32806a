#include "client/tcp_transport.h"
#include "client_fixture.h"

using namespace aibo_client;
using std::chrono::seconds;
using std::chrono::steady_clock;

namespace {

struct ClientWithLookup : public RcServerClient {
  ClientWithLookup(const ClientOptions& options, Resolver lookup)
      : RcServerClient(options, {}, std::make_unique<TcpTransport>(std::move(lookup))) {}
};

class StopTest : public ClientFixture {
 protected:
  static void expectToStopSoon(RcServerClient* client) {
    const auto begin = steady_clock::now();
    client->stop();
    EXPECT_LT(steady_clock::now() - begin, seconds(8)) << "what it waits for takes 10 s or more";
    EXPECT_EQ(ConnectionState::kDisconnected, client->status().state);
    EXPECT_FALSE(client->streaming());
    client->stop();
  }
};

TEST_F(StopTest, BeforeItWasStarted) {
  expectToStopSoon(&client_);
  EXPECT_THROW(client_.start(), Exception);
  EXPECT_THROW(client_.takePicture(0, seconds(1)), StoppedException);
}

TEST_F(StopTest, WhileConnectingToAnAddressThatDoesNotAnswer) {
  ScriptedServer full;
  full.listen(0);
  TcpTransport other;
  other.connect("127.0.0.1", full.port(), steady_clock::now() + seconds(10));
  Recorder recorder;
  RcServerClient client(optionsFor(full), recorder.callbacks());
  client.start();
  ASSERT_TRUE(recorder.waitForState(ConnectionState::kConnecting));
  expectToStopSoon(&client);
}

TEST_F(StopTest, WhileWaitingToReconnect) {
  server_.vanish();
  ClientOptions options = optionsFor(server_);
  options.reconnect_wait_min = seconds(60);
  options.reconnect_wait_max = seconds(60);
  Recorder recorder;
  RcServerClient client(options, recorder.callbacks());
  client.start();
  ASSERT_TRUE(eventually([&] { return recorder.logged("refused") > 0; }));
  expectToStopSoon(&client);
}

TEST_F(StopTest, WhileANameIsLookedUp) {
  std::promise<void> looking;
  std::promise<void> name_server_answers;
  std::promise<void> finished;
  auto resolver = [&, answer = name_server_answers.get_future().share()](const std::string&, int) {
    looking.set_value();
    answer.wait();
    finished.set_value();
    return NameLookupResult();
  };
  {
    ClientOptions options = optionsFor(server_);
    options.host = "aibo";
    ClientWithLookup client(options, resolver);
    client.start();
    looking.get_future().wait();
    expectToStopSoon(&client);
  }
  name_server_answers.set_value();  // the lookup goes on after the client is gone, and does no harm
  finished.get_future().wait();
}

TEST_F(StopTest, WhileTheStreamIsRunning) {
  ScriptedPeer peer = startStream();
  auto robot = std::async(std::launch::async, [&] {
    try {
      for (;;) {
        peer.sendPicture(test_pictures::make());
      }
    } catch (const std::exception&) {  // the client has gone
    }
  });
  ASSERT_TRUE(eventually([this] { return recorder_.reports().pictures.size() >= 10; }));
  expectToStopSoon(&client_);
  const std::size_t pictures = recorder_.reports().pictures.size();
  robot.wait();
  EXPECT_EQ(pictures, recorder_.reports().pictures.size());
}

TEST_F(StopTest, EndsCallsThatWait) {
  ScriptedPeer peer = connectVersion1();
  auto taken = std::async(std::launch::async, [&] { return client_.takePicture(40, seconds(60)); });
  expectCommand(&peer, 'F', 40);
  expectToStopSoon(&client_);
  EXPECT_THROW(taken.get(), StoppedException);
  peer.waitUntilClosed();
}

TEST_F(StopTest, EndsTheWaitForTheConnection) {
  client_.start();
  auto waiting = std::async(std::launch::async, [&] { client_.waitForConnection(seconds(60)); });
  client_.stop();
  EXPECT_THROW(waiting.get(), StoppedException);
}

// The client's thread cannot end while it is in a callback, so that all calls wait for it at the same time.
TEST_F(StopTest, FromSeveralThreadsAtOnceReturnsToEachOfThem) {
  std::promise<void> in_callback;
  std::promise<void> release;
  Callbacks callbacks;
  callbacks.on_status = [&](const ConnectionStatus& status) {
    if (status.state == ConnectionState::kConnected && status.reason.empty()) {
      in_callback.set_value();
      release.get_future().wait();
    }
  };
  RcServerClient client(optionsFor(server_), callbacks);
  client.start();
  const ScriptedPeer peer = accept();
  in_callback.get_future().wait();
  std::vector<std::future<ConnectionState>> stops;
  for (int i = 0; i < 4; ++i) {
    stops.push_back(std::async(std::launch::async, [&] {
      client.stop();
      return client.status().state;
    }));
  }
  for (auto& each : stops) {
    EXPECT_EQ(std::future_status::timeout, each.wait_for(std::chrono::milliseconds(50)))
        << "a callback is still running";
  }
  release.set_value();
  for (auto& each : stops) {
    EXPECT_EQ(ConnectionState::kDisconnected, each.get());
  }
}

}  // namespace
