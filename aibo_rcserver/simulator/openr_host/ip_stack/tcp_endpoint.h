/// @file tcp_endpoint.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_TCP_ENDPOINT_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_TCP_ENDPOINT_H

#include <TCPEndpointMsg.h>

#include "simulator/openr_host/ip_stack/endpoint.h"
#include "simulator/openr_host/ip_stack/tcp_listener.h"

namespace openr_host {

/// The states are: new; listening or connecting; connected; broken or closing; closed (OPEN-R SDK Internet Protocol
/// Version4, figure 4).
class TcpEndpoint : public Endpoint {
 public:
  static constexpr TCPEndpointError kOperationInvalid = TCP_OPERATION_INVALID;
  static constexpr TCPEndpointError kBufferInvalid = TCP_BUFFER_INVALID;

  /// @param pool_size the size of the socket's send buffer, in bytes
  /// @param deliver must outlive the object
  TcpEndpoint(int pool_size, const Deliver& deliver);

  bool isNew() const { return state_ == State::kNew; }

  /// The requests below are answered later, or at once with an error.
  void listen(const Envelope& message);
  void connect(const Envelope& message);
  void send(const Envelope& message);
  void receive(const Envelope& message);
  /// Closes the connection gracefully. A receive is answered with TCP_CONNECTION_CLOSED; an unfinished send continues.
  /// The answer comes when both sides have closed, or at once with `abort`.
  void close(const Envelope& message);

  /// True if close() would be answered at once.
  bool closesAtOnce(bool abort) const;

  /// Answers every unfinished request with an error.
  void closeAtOnce(bool abort);

  /// Called when a client has connected to this endpoint.
  void accept(TcpConnection connection);

  bool isClosed() const override { return state_ == State::kClosed; }
  bool uses(const std::function<bool(const void*, std::size_t)>& is_concerned) const override;
  void addTo(PollSet& poll_set) override;

 private:
  enum class State { kNew, kListening, kConnecting, kConnected, kBroken, kClosing, kClosed };

  template <typename Message>
  bool mayBegin(const PendingMessage<Message>& under_way, const Envelope& message) const;

  void becomeConnected(FileDescriptor socket);
  void finishConnecting();
  void goOnSending();
  void goOnReceiving();
  void goOnClosing();
  void breakOff(int error);
  void breakOffUnlessTransient(int error);
  void endReceive(TCPEndpointError error);

  const int pool_size_;
  const Deliver& deliver_;
  State state_ = State::kNew;
  TCPEndpointError why_broken_ = TCP_SUCCESS;
  FileDescriptor socket_;
  PendingMessage<TCPEndpointListenMsg> listening_;
  PendingMessage<TCPEndpointConnectMsg> connecting_;
  PendingMessage<TCPEndpointSendMsg> sending_;
  std::size_t sent_ = 0;
  PendingMessage<TCPEndpointReceiveMsg> receiving_;
  std::size_t received_ = 0;
  PendingMessage<TCPEndpointCloseMsg> closing_;
  bool said_goodbye_ = false;       ///< this side has closed the connection
  bool other_side_closed_ = false;  ///< the other side has closed it
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_TCP_ENDPOINT_H
