/// @file envelope.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_ENVELOPE_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_ENVELOPE_H

#include <ant.h>

#include <cstddef>
#include <cstring>
#include <memory>

namespace openr_host {

/// The stack's copy of a message that an object has sent, with where its answer goes.
class Envelope {
 public:
  /// @param size bytes of the message
  Envelope(const antEnvMsg& message, std::size_t size, const OID& object, Selector entry)
      : object_(object), entry_(entry), copy_(new std::max_align_t[size / sizeof(std::max_align_t) + 1]) {
    std::memcpy(copy_.get(), &message, size);
  }

  const OID& object() const { return object_; }
  Selector entry() const { return entry_; }

  ANTENVMSG content() const { return copy_.get(); }
  antEnvMsg& message() const { return *antEnvMsg::Receive(content()); }

  /// The message as what its operation says that it is.
  template <typename Message>
  Message& as() const {
    return static_cast<Message&>(message());
  }

 private:
  OID object_;
  Selector entry_;
  std::shared_ptr<std::max_align_t[]> copy_;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_ENVELOPE_H
