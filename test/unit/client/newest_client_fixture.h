/// @file newest_client_fixture.h
#ifndef TEST_UNIT_CLIENT_NEWEST_CLIENT_FIXTURE_H
#define TEST_UNIT_CLIENT_NEWEST_CLIENT_FIXTURE_H

#include <string>
#include <utility>

#include "client_fixture.h"

/// A client that asks for version 2 of the protocol.
class NewestClientFixture : public ClientFixture {
 protected:
  /// The first time, the client has had another robot before, whose connection broke in the middle of a message.
  ScriptedPeer connectVersion2(const std::string& capabilities = "F W J V T L K I U D P N Q R") {
    client().start();
    if (!std::exchange(has_met_a_robot_, true)) {
      ScriptedPeer before = server_.accept();
      before.agreeToVersion2("F J X G S");
      EXPECT_TRUE(recorder_.waitForState(aibo_client::ConnectionState::kConnected));
      before.send({'f', 0, 0, 0, 0, 0, 9, 9, 7, 7});
      before.reset();
    }
    ScriptedPeer peer = server_.accept();
    peer.agreeToVersion2(capabilities);
    EXPECT_TRUE(recorder_.waitForState(aibo_client::ConnectionState::kConnected));
    return peer;
  }

  ScriptedPeer connectVersion1() {
    client().start();
    has_met_a_robot_ = true;
    ScriptedPeer peer = accept();
    EXPECT_TRUE(recorder_.waitForState(aibo_client::ConnectionState::kConnected));
    return peer;
  }

  aibo_client::RcServerClient& client() { return newest_client_; }

  bool has_met_a_robot_ = false;
  aibo_client::RcServerClient newest_client_{optionsFor(server_), recorder_.callbacks()};
};

#endif  // TEST_UNIT_CLIENT_NEWEST_CLIENT_FIXTURE_H
