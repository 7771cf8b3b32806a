/// @file orders.h
/// Finds out who asks the driver for something, and since when.
#ifndef AIBO_DRIVER_NODE_ORDERS_H
#define AIBO_DRIVER_NODE_ORDERS_H

#include <ros/message_event.h>

#include <cstddef>
#include <string>

#include "movement/movement.h"
#include "node/callback_threads.h"
#include "text/plain_text.h"

namespace aibo_driver::node {

/// The order that a message gives. Call this in the message's callback.
template <typename Message>
movement::Order orderOf(const ros::MessageEvent<Message const>& event) {
  return {text::plainLine(event.getPublisherName()), receivedAt()};  // a stranger may choose the name
}

/// The order that a goal of an action, or its cancelling, gives. Call this in the callback.
/// @param goal_id an id as actionlib's clients make it: the node, a number and a time, with hyphens between them
inline movement::Order orderOfGoal(const std::string& goal_id) {
  const std::size_t time = goal_id.rfind('-');
  const std::size_t number = time == std::string::npos || time == 0 ? time : goal_id.rfind('-', time - 1);
  return {text::plainLine(goal_id.substr(0, number)), receivedAt()};
}

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_ORDERS_H
