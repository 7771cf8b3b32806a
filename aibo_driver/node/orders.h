/// @file orders.h
/// Receives orders: who asks the driver for something, and since when.
#ifndef AIBO_DRIVER_NODE_ORDERS_H
#define AIBO_DRIVER_NODE_ORDERS_H

#include <ros/message_event.h>
#include <ros/node_handle.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "movement/movement.h"
#include "node/bounded_message.h"
#include "node/callback_threads.h"
#include "text/plain_text.h"

namespace aibo_driver::node {

/// Subscribes to a topic on which nodes give orders.
/// @param receive called with each message and its Order
template <typename Message, typename Receive>
ros::Subscriber subscribeToOrders(ros::NodeHandle handle, const std::string& topic, std::uint32_t queue_size,
                                  const Receive& receive) {
  using Event = ros::MessageEvent<Message const>;
  const boost::function<void(const Event&)> on_event = [receive](const Event& event) {
    // A stranger may choose the name of the node.
    receive(*event.getMessage(), movement::Order{text::plainLine(event.getPublisherName()), receivedAt()});
  };
  return handle.subscribe<Message>(topic, queue_size, on_event, {}, ros::TransportHints().tcpNoDelay());
}

/// The same for a topic on which longer messages than `most_bytes` are refused.
/// @param refuse called with the Order of such a message, and with the reason
template <typename Message, std::size_t most_bytes, typename Receive, typename Refuse>
ros::Subscriber subscribeToOrders(const ros::NodeHandle& handle, const std::string& topic, std::uint32_t queue_size,
                                  const Receive& receive, const Refuse& refuse) {
  using Bounded = BoundedMessage<Message, most_bytes>;
  return subscribeToOrders<Bounded>(handle, topic, queue_size, [=](const Bounded& bounded, const auto& order) {
    const std::string refusal = bounded.refusal();
    if (refusal.empty()) {
      receive(bounded.message, order);
    } else {
      refuse(order, refusal);
    }
  });
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
