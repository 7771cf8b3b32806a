/// @file joint_link.h
#ifndef AIBO_DRIVER_MOVEMENT_JOINT_LINK_H
#define AIBO_DRIVER_MOVEMENT_JOINT_LINK_H

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "aibo_client/joints.h"
#include "aibo_client/rcserver_client.h"

namespace aibo_driver::movement {

/// Call this before a command is sent. To a robot of another design, the numbers in the command mean other joints and
/// LEDs. A version 1 server does not report the design of its robot, so everything passes. Any thread may call it.
/// @param design the design that the commands are made for, such as "ERS-7"; empty means any design
/// @throw CommandException the connected robot reports another design
void requireDesign(const aibo_client::RcServerClient& client, const std::string& design);

/// Where a joint should go, and how fast it may go at most.
struct JointOrder {
  double position = 0;  ///< rad
  double speed = 0;     ///< rad/s, above 0
};

/// Orders by RCServer identifier. Each joint appears once.
using JointOrders = std::map<int, JointOrder>;

/// Sends orders to the robot: first the speed limits that change, then all positions in one request. The robot itself
/// keeps the speed limits, so they hold even if a message is late, and with every version of the protocol.
///
/// Only one thread at a time may use it.
class JointLink {
 public:
  /// @param client must outlive the link
  /// @param design the design that the orders are for; empty means any design. A robot of another design gets no
  ///   orders: see requireDesign()
  explicit JointLink(aibo_client::RcServerClient& client, std::string design = "")
      : client_(client), design_(std::move(design)) {}

  /// Sends orders to the robot. It sends nothing if there are no orders.
  /// @param duration, terms see RcServerClient::commandJoints()
  /// @throw the exceptions of requireDesign() and RcServerClient::commandJoints()
  void send(const JointOrders& orders, std::chrono::milliseconds duration, const aibo_client::OrderTerms& terms = {});

  /// Checks an order that is prepared now and sent later.
  /// @throw the exceptions of movement::requireDesign()
  void requireDesign() const { movement::requireDesign(client_, design_); }

  /// Limits how fast joints may move, whoever moves them. Limits that the robot already has are not sent again.
  /// @param limits each joint appears once
  /// @throw the exceptions of requireDesign() and RcServerClient::setJointSpeedLimits()
  void limitSpeeds(const std::vector<aibo_client::JointSpeedLimit>& limits);

  /// The number of connections so far. If it has changed between two calls, there is a new connection. Then nothing
  /// that was sent over the old one may be repeated.
  std::uint64_t connection() const { return client_.statistics().connections; }

 private:
  aibo_client::RcServerClient& client_;
  const std::string design_;
  std::uint64_t speeds_connection_ = 0;
  std::map<int, double> speeds_;  ///< rad/s, by id; the limits in force over that connection
};

}  // namespace aibo_driver::movement

#endif  // AIBO_DRIVER_MOVEMENT_JOINT_LINK_H
