/// @file attacks.h
/// What a hostile robot does to a driver, and a hostile client to an RCServer.
#ifndef TEST_FAULT_HOSTILE_ATTACKS_H
#define TEST_FAULT_HOSTILE_ATTACKS_H

#include <chrono>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "support/picture_server.h"

namespace hostile {

using Random = std::mt19937;
using TimePoint = std::chrono::steady_clock::time_point;

/// An attack of a robot. It is endless, so its user has to end it.
struct RobotAttack {
  std::string name;
  int version;  ///< of the protocol, 1 or 2
  std::function<test_support::PictureServer::Flood(unsigned seed)> begin;
};

/// All of them; names are unique together with the version.
const std::vector<RobotAttack>& robotAttacks();

/// An attack of clients.
struct ClientAttack {
  std::string name;
  bool at_console;  ///< not at the server's port
  int clients;      ///< at the same time
  bool reads;       ///< whether they read the answers
  std::string first;
  std::function<std::string(Random& random)> more;  ///< what they send again and again; null: they wait
};

const std::vector<ClientAttack>& clientAttacks();

/// Attacks a port of 127.0.0.1 until `end`. When the server ends a connection, the attacker makes a new one.
void carryOut(const ClientAttack& attack, int port, Random& random, TimePoint end);

}  // namespace hostile

#endif  // TEST_FAULT_HOSTILE_ATTACKS_H
