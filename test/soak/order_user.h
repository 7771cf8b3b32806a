/// @file order_user.h
#ifndef TEST_SOAK_ORDER_USER_H
#define TEST_SOAK_ORDER_USER_H

#include <string>

#include "order_audit.h"

namespace soak {

/// The topics of the soak itself, beside the driver's namespace.
constexpr const char* kUserRuns = "/soak/runs";      ///< std_msgs/UInt32: a round; even: orders come, odd: none
constexpr const char* kUserCalls = "/soak/calls";    ///< std_msgs/String: a Call
constexpr const char* kUserOrders = "/soak/orders";  ///< JointState: a command, with its time and its user as the frame

/// In place of a service: the user has given its last order before the round of the message.
constexpr const char* kQuiet = "quiet";

std::string toText(const Call& call);
Call parseCall(const std::string& text);

/// A node that gives random orders of all kinds, one after the other, while it is told to run. Its orders never have
/// the same target twice, and no other user's. Returns when ROS ends.
/// @param name_space the driver's
/// @param number of this user, 0..4
void runUser(const std::string& name_space, unsigned number, unsigned seed);

}  // namespace soak

#endif  // TEST_SOAK_ORDER_USER_H
