/// @file bounded_message.h
#ifndef AIBO_DRIVER_NODE_BOUNDED_MESSAGE_H
#define AIBO_DRIVER_NODE_BOUNDED_MESSAGE_H

#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <cstddef>
#include <string>

namespace aibo_driver::node {

/// A message that is not read if it is too long. Reading a million names takes processor time that is needed elsewhere,
/// for example for stop.
template <typename Message, std::size_t most_bytes>
struct BoundedMessage {
  Message message;          ///< empty if the message was too long
  std::size_t skipped = 0;  ///< the length in bytes of a message that was too long; otherwise 0

  /// Why the message is refused, in words to put after a colon; empty if it is not too long.
  std::string refusal() const {
    return skipped == 0 ? ""
                        : "it has " + std::to_string(skipped) + " bytes, and at most " + std::to_string(most_bytes) +
                              " bytes are allowed";
  }
};

}  // namespace aibo_driver::node

namespace ros::message_traits {

template <typename Message, std::size_t most_bytes>
struct MD5Sum<aibo_driver::node::BoundedMessage<Message, most_bytes>> : MD5Sum<Message> {};
template <typename Message, std::size_t most_bytes>
struct DataType<aibo_driver::node::BoundedMessage<Message, most_bytes>> : DataType<Message> {};
template <typename Message, std::size_t most_bytes>
struct Definition<aibo_driver::node::BoundedMessage<Message, most_bytes>> : Definition<Message> {};

}  // namespace ros::message_traits

namespace ros::serialization {

template <typename Message, std::size_t most_bytes>
struct Serializer<aibo_driver::node::BoundedMessage<Message, most_bytes>> {
  template <typename Stream>
  static void read(Stream& stream, aibo_driver::node::BoundedMessage<Message, most_bytes>& bounded) {
    if (stream.getLength() > most_bytes) {
      bounded.skipped = stream.getLength();
    } else {
      Serializer<Message>::read(stream, bounded.message);
    }
  }
};

}  // namespace ros::serialization

#endif  // AIBO_DRIVER_NODE_BOUNDED_MESSAGE_H
