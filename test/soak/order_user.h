/// @file order_user.h
#ifndef TEST_SOAK_ORDER_USER_H
#define TEST_SOAK_ORDER_USER_H

#include <optional>
#include <string>

#include "order_events.h"

namespace soak {

/// The topics of the soak itself, beside the driver's namespace.
constexpr const char* kUserLog = "/soak/log";    ///< std_msgs/String: a line for each order and call
constexpr const char* kUserRuns = "/soak/runs";  ///< std_msgs/UInt32: a round; even: orders come, odd: none

/// A line of a user's log.
struct UserLine {
  std::optional<Order> order{};
  std::optional<Call> call{};
  std::optional<unsigned> quiet_in{};  ///< the user has given its last order before this round
};

std::string toText(const Order& order);
std::string toText(const Call& call);
std::string quietIn(unsigned round, const std::string& user);

/// @throw std::runtime_error the line is none of the above
UserLine parseUserLine(const std::string& text);

/// A node that gives random orders of all kinds, one after the other, while it is told to run. Its orders never have
/// the same target twice, and no other user's. Returns when ROS ends.
/// @param name_space the driver's
/// @param number of this user, 0..4
void runUser(const std::string& name_space, unsigned number, unsigned seed);

}  // namespace soak

#endif  // TEST_SOAK_ORDER_USER_H
