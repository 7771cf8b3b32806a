/// @file pending_message.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_PENDING_MESSAGE_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_PENDING_MESSAGE_H

#include <functional>
#include <optional>
#include <utility>

#include "simulator/openr_host/ip_stack/envelope.h"

namespace openr_host {

/// Takes an answered message back to the object that sent it.
using Deliver = std::function<void(const Envelope&)>;

/// Answers a message with an error.
template <typename Message, typename Error>
void answer(const Deliver& deliver, const Envelope& message, Error error) {
  message.as<Message>().error = error;
  deliver(message);
}

/// What an endpoint was asked for and has not answered yet: at most one message of a kind.
template <typename Message>
class PendingMessage {
 public:
  /// @param deliver must outlive this
  explicit PendingMessage(const Deliver& deliver) : deliver_(deliver) {}

  explicit operator bool() const { return envelope_.has_value(); }
  Message* operator->() const { return &envelope_->template as<Message>(); }

  void begin(const Envelope& message) { envelope_ = message; }

  /// Answers the message. Does nothing if there is none.
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

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_PENDING_MESSAGE_H
