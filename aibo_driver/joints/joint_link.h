/// @file joint_link.h
#ifndef AIBO_DRIVER_JOINTS_JOINT_LINK_H
#define AIBO_DRIVER_JOINTS_JOINT_LINK_H

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "aibo_driver/joints.h"

namespace aibo_driver::joints {

/// What a joint is told: where to go, and how fast at most.
struct JointOrder {
  int id = 0;
  double position = 0;  ///< rad
  double speed = 0;     ///< rad/s, above 0
};

/// Passes orders on to the robot: speed limits, where they have to change, then the positions together. A speed limit
/// is the robot's to keep, so it holds however late a message comes, and with every version of the protocol.
///
/// From one thread at a time.
class JointLink {
 public:
  /// What is needed of RcServerClient.
  struct Robot {
    std::function<std::uint64_t()> connections;  ///< grows with each connection
    std::function<void(const std::vector<JointSpeedLimit>&)> set_speed_limits;
    std::function<void(const std::vector<JointTarget>&, std::chrono::milliseconds)> command;
  };

  explicit JointLink(Robot robot);

  /// @param orders each joint once; nothing is sent if there are none
  /// @param duration as for RcServerClient::commandJoints()
  /// @throw as RcServerClient::commandJoints()
  void send(const std::vector<JointOrder>& orders, std::chrono::milliseconds duration);

  /// Tells the robot how fast joints may move, whoever moves them. What it knows already is not sent again.
  /// @param limits each joint once
  /// @throw as RcServerClient::setJointSpeedLimits()
  void limitSpeeds(const std::vector<JointSpeedLimit>& limits);

  /// Differs between two calls if a new connection was made in between: what was told to the robot before is not to be
  /// told again.
  std::uint64_t connection() const { return robot_.connections(); }

 private:
  const Robot robot_;
  std::uint64_t speeds_connection_ = 0;
  std::map<int, double> speeds_;  ///< in force over that connection, by id
};

}  // namespace aibo_driver::joints

#endif  // AIBO_DRIVER_JOINTS_JOINT_LINK_H
