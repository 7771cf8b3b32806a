/// @file publish_latched.h
#ifndef AIBO_DRIVER_NODE_PUBLISH_LATCHED_H
#define AIBO_DRIVER_NODE_PUBLISH_LATCHED_H

#include <ros/publisher.h>

namespace aibo_driver::node {

/// Publishes a state on a latched topic. The state may be sent twice, so it must not be an event. roscpp sends a
/// message to its subscribers first, and only then keeps it for later ones. A subscriber that comes in between would
/// see the previous state, until the next change.
template <typename Message>
void publishLatched(const ros::Publisher& publisher, const Message& state) {
  const auto subscribers = publisher.getNumSubscribers();
  publisher.publish(state);
  if (publisher.getNumSubscribers() != subscribers) {
    publisher.publish(state);
  }
}

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_PUBLISH_LATCHED_H
