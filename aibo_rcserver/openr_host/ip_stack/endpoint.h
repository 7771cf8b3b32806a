/// @file endpoint.h
#ifndef OPENR_HOST_IP_STACK_ENDPOINT_H
#define OPENR_HOST_IP_STACK_ENDPOINT_H

#include <TCPEndpointMsg.h>

#include <functional>
#include <optional>

#include "openr_host/ip_stack/envelope.h"
#include "openr_host/ip_stack/poll_set.h"
#include "openr_host/ip_stack/tcp_listener.h"

namespace openr_host {

/// One TCP endpoint of the IPStack: new, then listening, then connected, then broken or closed.
class Endpoint {
 public:
  using Deliver = std::function<void(const Envelope&)>;

  /// @param pool_size bytes for the socket's send buffer
  /// @param deliver takes answered messages
  Endpoint(std::size_t pool_size, Deliver deliver);

  bool isNew() const { return state_ == State::kNew; }
  bool isListening() const { return state_ == State::kListening; }

  /// @name Begin what a message asks for. Each is answered later, or at once with an error.
  /// @{
  void listen(const Envelope& message);
  void send(const Envelope& message);
  void receive(const Envelope& message);
  /// @}

  /// A client has come to this listening endpoint.
  void accept(TcpConnection connection);

  /// Answers whatever is under way with TCP_CONNECTION_CLOSED.
  /// @return the socket, if the endpoint is connected
  FileDescriptor close();

  /// Whether something under way uses memory for which this is true.
  bool uses(const std::function<bool(const void*, std::size_t)>& is_concerned) const;

  void addTo(PollSet& poll_set);

 private:
  enum class State { kNew, kListening, kConnected, kBroken };

  template <typename Message>
  void answer(std::optional<Envelope>& message, TCPEndpointError error);
  template <typename Message>
  void refuse(const Envelope& message, TCPEndpointError error) const;
  template <typename Message>
  bool mayBegin(const std::optional<Envelope>& under_way, const Envelope& message) const;

  void goOnSending();
  void goOnReceiving();
  void breakOff(int error);

  const std::size_t pool_size_;
  const Deliver deliver_;
  State state_ = State::kNew;
  TCPEndpointError why_broken_ = TCP_SUCCESS;
  FileDescriptor socket_;
  std::optional<Envelope> listening_;
  std::optional<Envelope> sending_;
  std::size_t sent_ = 0;
  std::optional<Envelope> receiving_;
  std::size_t received_ = 0;
};

}  // namespace openr_host

#endif  // OPENR_HOST_IP_STACK_ENDPOINT_H
