/// @file joint_link.h
#ifndef AIBO_DRIVER_MOVEMENT_JOINT_LINK_H
#define AIBO_DRIVER_MOVEMENT_JOINT_LINK_H

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "aibo_driver/joints.h"
#include "aibo_driver/rcserver_client.h"

namespace aibo_driver::movement {

/// To be called before a command is sent: the numbers in it mean other joints and LEDs to a robot of another design.
/// A version 1 server does not say which design its robot is, so everything passes. From any thread.
/// @param design that the commands are made for, such as "ERS-7"; empty: any
/// @throw CommandException the connected robot says that it is of another design
void requireDesign(const RcServerClient& client, const std::string& design);

/// Where a joint is to go, and how fast at most.
struct JointOrder {
  double position = 0;  ///< rad
  double speed = 0;     ///< rad/s, above 0
};

/// Orders by RCServer identifier: each joint is there once.
using JointOrders = std::map<int, JointOrder>;

/// Sends orders to the robot: first the speed limits that change, then all positions in one request. The robot itself
/// keeps the speed limits, so they hold even if a message is late, and with every version of the protocol.
///
/// From one thread at a time.
class JointLink {
 public:
  /// @param client must outlive the link
  /// @param design of the robot that the orders are for; empty: any. A robot of another one gets none: see
  ///   requireDesign().
  explicit JointLink(RcServerClient& client, std::string design = "") : client_(client), design_(std::move(design)) {}

  /// Sends nothing if there are no orders.
  /// @param duration, terms as for RcServerClient::commandJoints()
  /// @throw as requireDesign() and RcServerClient::commandJoints()
  void send(const JointOrders& orders, std::chrono::milliseconds duration, const OrderTerms& terms = {});

  /// For what is prepared now and sent later.
  /// @throw as movement::requireDesign()
  void requireDesign() const { movement::requireDesign(client_, design_); }

  /// Limits how fast joints may move, whoever moves them. Limits that the robot already has are not sent again.
  /// @param limits each joint once
  /// @throw as requireDesign() and RcServerClient::setJointSpeedLimits()
  void limitSpeeds(const std::vector<JointSpeedLimit>& limits);

  /// Counts the connections. If it has changed between two calls, there is a new connection, and nothing that was sent
  /// over the old one may be repeated.
  std::uint64_t connection() const { return client_.statistics().connections; }

 private:
  RcServerClient& client_;
  const std::string design_;
  std::uint64_t speeds_connection_ = 0;
  std::map<int, double> speeds_;  ///< rad/s, in force over that connection, by id
};

}  // namespace aibo_driver::movement

#endif  // AIBO_DRIVER_MOVEMENT_JOINT_LINK_H
