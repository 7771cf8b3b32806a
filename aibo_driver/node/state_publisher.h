/// @file state_publisher.h
/// Publishes states on latched topics. A state may be sent twice, so it must not be an event.
#ifndef AIBO_DRIVER_NODE_STATE_PUBLISHER_H
#define AIBO_DRIVER_NODE_STATE_PUBLISHER_H

#include <ros/message_traits.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <optional>
#include <string>
#include <utility>

namespace aibo_driver::node {

/// Publishes a state on a latched topic. roscpp sends a message to its subscribers first, and only then keeps it for
/// later ones. A subscriber that comes in between would see the previous state, until the next change.
template <typename Message>
void publishLatched(const ros::Publisher& publisher, const Message& state) {
  const auto subscribers = publisher.getNumSubscribers();
  publisher.publish(state);
  if (publisher.getNumSubscribers() != subscribers) {
    publisher.publish(state);
  }
}

/// A latched topic. Only one thread at a time may use it.
template <typename Message>
class StatePublisher {
 public:
  StatePublisher(ros::NodeHandle handle, const std::string& topic) {
    constexpr bool kLatched = true;
    publisher_ = handle.advertise<Message>(topic, 10, kLatched);
  }

  /// Publishes a state unless it is the same as the last one. It never blocks.
  /// @param state a message without a stamp; if it has a header, it is stamped with the present time
  void publish(Message state) {
    if (last_ && *last_ == state) {
      return;
    }
    last_ = state;
    if constexpr (ros::message_traits::HasHeader<Message>::value) {
      state.header.stamp = ros::Time::now();
    }
    publishLatched(publisher_, state);
  }

 private:
  ros::Publisher publisher_;
  std::optional<Message> last_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_STATE_PUBLISHER_H
