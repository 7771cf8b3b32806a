/// @file newest_client_fixture.h
#ifndef TEST_UNIT_CLIENT_NEWEST_CLIENT_FIXTURE_H
#define TEST_UNIT_CLIENT_NEWEST_CLIENT_FIXTURE_H

#include <string>

#include "client_fixture.h"

/// A client that asks for version 2 of the protocol.
class NewestClientFixture : public ClientFixture {
 protected:
  static aibo_driver::ClientOptions newest(const ScriptedServer& server) {
    aibo_driver::ClientOptions options = optionsFor(server);
    options.protocol_version = 0;
    return options;
  }

  ScriptedPeer connectVersion2(const std::string& capabilities = "F W J V T L K I U D P N Q R") {
    client().start();
    ScriptedPeer peer = server_.accept();
    peer.agreeToVersion2(capabilities);
    EXPECT_TRUE(recorder_.waitForState(aibo_driver::ConnectionState::kConnected));
    return peer;
  }

  ScriptedPeer connectVersion1() {
    client().start();
    ScriptedPeer peer = server_.accept();
    expectCommand(&peer, 'X', 2);
    peer.send({'e', 0, 0, 0});
    EXPECT_TRUE(recorder_.waitForState(aibo_driver::ConnectionState::kConnected));
    return peer;
  }

  aibo_driver::RcServerClient& client() { return newest_client_; }

  aibo_driver::RcServerClient newest_client_{newest(server_), recorder_.callbacks()};
};

#endif  // TEST_UNIT_CLIENT_NEWEST_CLIENT_FIXTURE_H
