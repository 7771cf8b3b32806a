/// @file order_audit.h
/// What happens in the soak, and whether it may. All times are in seconds since the epoch, by the system clock, which
/// all processes of a computer and the stamps of ROS share.
#ifndef TEST_SOAK_ORDER_AUDIT_H
#define TEST_SOAK_ORDER_AUDIT_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace soak {

using Targets = std::map<std::string, double>;  ///< rad, by joint

/// A command of a user that moves joints.
struct Order {
  std::string user;  ///< the node
  double time = 0;   ///< when it was published
  Targets targets{};
};

constexpr const char* kNoAnswer = "no answer came";

/// A call of a service by a user.
struct Call {
  std::string user;
  std::string service;
  double begin = 0;
  double end = 0;
  bool success = false;
  std::string message{};  ///< or kNoAnswer
};

/// A joint's target that the robot has accepted.
struct Accepted {
  double time = 0;
  std::string joint;
  double target = 0;  ///< rad, as it was asked for
};

/// Something that moves the robot, as motion_state names it.
struct Moving {
  std::uint64_t order = 0;  ///< its number
  std::string user;
  int kind = 0;  ///< as in aibo_driver/Movement
  std::string name;
};

/// Where the joints are.
struct Measured {
  double time = 0;  ///< by the stamp
  Targets positions{};
};

/// All that happened in one round, each in the order of time.
struct Round {
  std::vector<Order> orders{};
  std::vector<Call> calls{};
  std::vector<Accepted> accepted{};
  std::map<std::uint64_t, Moving> begun{};
  std::vector<Moving> ended{};
  std::vector<Moving> moving{};  ///< at its end
  std::vector<Measured> measured{};
  std::vector<std::string> faults{};  ///< with their times
};

/// Judges what happened in each round by the contract of docs/ros_interface.md.
class OrderAudit {
 public:
  /// @param complain is called with each violation
  explicit OrderAudit(std::function<void(const std::string&)> complain) : complain_(std::move(complain)) {}

  /// @param round in which all orders have ended
  void judge(const Round& round);

  /// How many stops and accepted commands were judged.
  std::size_t stops() const { return stops_; }
  std::size_t commands() const { return commands_; }

 private:
  void judgeEnds(const Round& round);
  void judgeStop(const Round& round, const Call& stop);
  void judgeAge(const Round& round);

  const std::function<void(const std::string&)> complain_;
  std::size_t stops_ = 0;
  std::size_t commands_ = 0;
};

/// A time in words: the seconds since the last full hour.
std::string hourClock(double time);

}  // namespace soak

#endif  // TEST_SOAK_ORDER_AUDIT_H
