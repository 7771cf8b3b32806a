/// @file endpoint.h
/// Endpoints of the IPStack, and the messages that they answer.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_ENDPOINT_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_ENDPOINT_H

#include <ant.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "simulator/openr_host/ip_stack/poll_set.h"

namespace openr_host {

/// The stack's copy of an object's message, with the receiver of the answer.
class Envelope {
 public:
  /// @param size the size of the message, in bytes
  Envelope(const antEnvMsg& message, std::size_t size, const OID& object, Selector entry)
      : object_(object), entry_(entry), copy_(new std::max_align_t[size / sizeof(std::max_align_t) + 1]) {
    std::memcpy(copy_.get(), &message, size);
  }

  const OID& object() const { return object_; }
  Selector entry() const { return entry_; }

  ANTENVMSG content() const { return copy_.get(); }
  antEnvMsg& message() const { return *antEnvMsg::Receive(content()); }

  /// The message as the type of its operation.
  template <typename Message>
  Message& as() const {
    return static_cast<Message&>(message());
  }

 private:
  OID object_;
  Selector entry_;
  std::shared_ptr<std::max_align_t[]> copy_;
};

/// Returns an answered message to its object.
using Deliver = std::function<void(const Envelope&)>;

template <typename Message, typename Error>
void answer(const Deliver& deliver, const Envelope& message, Error error) {
  message.as<Message>().error = error;
  deliver(message);
}

/// An endpoint's unanswered request of one kind; there is at most one.
template <typename Message>
class PendingMessage {
 public:
  /// @param deliver must outlive the object
  explicit PendingMessage(const Deliver& deliver) : deliver_(deliver) {}

  explicit operator bool() const { return envelope_.has_value(); }
  Message* operator->() const { return &envelope_->template as<Message>(); }

  void begin(const Envelope& message) { envelope_ = message; }

  template <typename Error>
  void end(Error error) {
    if (envelope_) {
      answer<Message>(deliver_, *std::exchange(envelope_, std::nullopt), error);
    }
  }

 private:
  const Deliver& deliver_;
  std::optional<Envelope> envelope_;
};

/// The IPStack's error for an error of the system.
template <typename Error>
Error errorOf(int error, const std::map<int, Error>& errors, Error other) {
  const auto found = errors.find(error);
  return found == errors.end() ? other : found->second;
}

/// True for errors after which a call can be repeated when the socket is ready.
inline bool isTransient(int error) {
  return error == EAGAIN || error == EINTR;
}

/// Converts a size, which must be 1 or more.
inline std::size_t sizeOf(int size) {
  return static_cast<std::size_t>(size);
}

class Endpoint {
 public:
  Endpoint() = default;
  virtual ~Endpoint() = default;
  Endpoint(const Endpoint&) = delete;
  Endpoint& operator=(const Endpoint&) = delete;

  /// True if all requests are answered and no more are accepted.
  virtual bool isClosed() const = 0;

  /// True if an unfinished request uses memory for which `is_concerned` returns true.
  virtual bool uses(const std::function<bool(const void*, std::size_t)>& is_concerned) const = 0;

  /// Adds the socket, with a handler, if the endpoint waits for it.
  virtual void addTo(PollSet& poll_set) = 0;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_ENDPOINT_H
