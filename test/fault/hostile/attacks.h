/// @file attacks.h
/// What a hostile robot does to a driver, and a hostile client to an RCServer. Each attack is endless; whoever uses it
/// ends it.
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

/// An attack of a robot.
struct RobotAttack {
  std::string name;
  std::string title;
  int version;  ///< of the protocol, 1 or 2
  std::function<test_support::PictureServer::Misbehaviour(unsigned seed)> begin;
};

/// All of them; names are unique together with the version.
const std::vector<RobotAttack>& robotAttacks();

/// Where a server listens, on 127.0.0.1.
struct Target {
  int port = 0;
  int console_port = 0;
};

/// An attack of clients.
struct ClientAttack {
  std::string name;
  std::string title;
  /// Attacks until `end`, at least once. Errors of the network are part of it.
  std::function<void(const Target& target, Random& random, TimePoint end)> run;
};

const std::vector<ClientAttack>& clientAttacks();

/// The attack with this name.
/// @throw std::invalid_argument there is none
const RobotAttack& findRobotAttack(const std::string& name, int version);

}  // namespace hostile

#endif  // TEST_FAULT_HOSTILE_ATTACKS_H
