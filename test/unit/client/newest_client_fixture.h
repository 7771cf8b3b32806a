/// @file newest_client_fixture.h
#ifndef TEST_UNIT_CLIENT_NEWEST_CLIENT_FIXTURE_H
#define TEST_UNIT_CLIENT_NEWEST_CLIENT_FIXTURE_H

#include <string>

#include "client_fixture.h"

/// A client that asks for version 2 of the protocol.
class NewestClientFixture : public ClientFixture {
 protected:
  ScriptedPeer connectVersion2(const std::string& capabilities = "F W J V T L K I U D P N Q R") {
    client().start();
    ScriptedPeer peer = server_.accept();
    peer.agreeToVersion2(capabilities);
    EXPECT_TRUE(recorder_.waitForState(aibo_client::ConnectionState::kConnected));
    return peer;
  }

  ScriptedPeer connectVersion1() {
    client().start();
    ScriptedPeer peer = accept();
    EXPECT_TRUE(recorder_.waitForState(aibo_client::ConnectionState::kConnected));
    return peer;
  }

  aibo_client::RcServerClient& client() { return newest_client_; }

  aibo_client::RcServerClient newest_client_{optionsFor(server_), recorder_.callbacks()};
};

#endif  // TEST_UNIT_CLIENT_NEWEST_CLIENT_FIXTURE_H
