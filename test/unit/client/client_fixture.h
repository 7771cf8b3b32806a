/// @file client_fixture.h
#ifndef TEST_UNIT_CLIENT_CLIENT_FIXTURE_H
#define TEST_UNIT_CLIENT_CLIENT_FIXTURE_H

#include <gmock/gmock.h>

#include "aibo_client/exceptions.h"
#include "aibo_client/rcserver_client.h"
#include "recorder.h"
#include "support/refusal.h"
#include "support/safety_net.h"
#include "support/scripted_server.h"
#include "support/test_pictures.h"

using test_support::eventually;
using test_support::refusalOf;
using test_support::ScriptedPeer;
using test_support::ScriptedServer;

/// A client and the server it talks to, over loopback.
class ClientFixture : public testing::Test {
 protected:
  static constexpr char kCapabilities[] = "F W J V T L K I U P S E";

  static aibo_client::ClientOptions optionsFor(const ScriptedServer& server) {
    aibo_client::ClientOptions options;
    options.port = server.port();
    options.connect_timeout = std::chrono::seconds(12);
    options.jpeg_quality = 73;
    options.read_timeout = std::chrono::seconds(10);
    options.reconnect_wait_min = std::chrono::milliseconds(10);
    options.reconnect_wait_max = std::chrono::milliseconds(50);
    return options;
  }

  /// The client connects to a server of version 2.
  ScriptedPeer connectVersion2(const std::string& capabilities = kCapabilities) {
    return connectVersion2(&client_, capabilities);
  }

  /// A client of the test's own does.
  ScriptedPeer connectVersion2(aibo_client::RcServerClient* client, const std::string& capabilities = kCapabilities) {
    client->start();
    ScriptedPeer peer = server_.accept();
    peer.agreeToVersion2(capabilities);
    EXPECT_TRUE(eventually([&] {
      return client->status().state == aibo_client::ConnectionState::kConnected &&
             client->status().protocol_version == 2;
    }));
    return peer;
  }

  /// The client connects to a server of version 1.
  ScriptedPeer connectVersion1() {
    client_.start();
    ScriptedPeer peer = accept();
    EXPECT_TRUE(recorder_.waitForState(aibo_client::ConnectionState::kConnected));
    return peer;
  }

  /// Waits for the client to come (back), and answers that the server speaks version 1.
  ScriptedPeer accept() {
    ScriptedPeer peer = server_.accept();
    expectCommand(&peer, 'X', 2);
    peer.send({'e', 0, 0, 0});
    return peer;
  }

  /// Starts the client, and its stream.
  /// @return the server's end
  ScriptedPeer startStream() {
    client_.setStreaming(true);
    client_.start();
    return acceptStream();
  }

  /// Waits for the client to come (back) and to ask for its stream.
  ScriptedPeer acceptStream() {
    ScriptedPeer peer = accept();
    expectCommand(&peer, 'W', 73);
    return peer;
  }

  static void expectCommand(ScriptedPeer* peer, char letter, int quality) {
    const protocol::BasicGetCommand command = peer->readCommand();
    EXPECT_EQ(letter, command.command);
    EXPECT_EQ(quality, command.identifier);
  }

  /// Lets `send` send one picture of the stream, again and again until it is delivered. If this computer is too busy to
  /// read a picture at once, it is stale and dropped.
  template <typename Send>
  static void sendUntilDelivered(const aibo_client::RcServerClient& client, const Send& send) {
    const std::uint64_t before = client.statistics().pictures;
    const auto handled = [&] { return client.statistics().pictures + client.statistics().stale_pictures; };
    EXPECT_TRUE(eventually([&] {
      const std::uint64_t handled_before = handled();
      send();
      EXPECT_TRUE(eventually([&] { return handled() > handled_before; })) << "a picture was lost";
      return client.statistics().pictures > before || testing::Test::HasFailure();
    }));
  }

  void sendUntilDelivered(ScriptedPeer* peer, const test_pictures::Bytes& jpeg) {
    sendUntilDelivered(client_, [&] { peer->sendPicture(jpeg); });
  }

  ScriptedServer server_;
  Recorder recorder_;
  aibo_client::RcServerClient client_{optionsFor(server_), recorder_.callbacks()};
};

#endif  // TEST_UNIT_CLIENT_CLIENT_FIXTURE_H
