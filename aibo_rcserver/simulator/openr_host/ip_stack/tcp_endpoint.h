/// @file tcp_endpoint.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_TCP_ENDPOINT_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_TCP_ENDPOINT_H

#include <TCPEndpointMsg.h>

#include "simulator/openr_host/ip_stack/endpoint.h"
#include "simulator/openr_host/ip_stack/tcp_listener.h"

namespace openr_host {

/// A TCP endpoint: new, then listening or connecting, then connected, then broken or closing, then closed (OPEN-R SDK
/// Internet Protocol Version4, figure 4).
class TcpEndpoint : public Endpoint {
 public:
  static constexpr TCPEndpointError kOperationInvalid = TCP_OPERATION_INVALID;
  static constexpr TCPEndpointError kBufferInvalid = TCP_BUFFER_INVALID;

  /// @param pool_size bytes for the socket's send buffer
  /// @param deliver must outlive this
  TcpEndpoint(int pool_size, const Deliver& deliver);

  bool isNew() const { return state_ == State::kNew; }

  /// @name Begin what a message asks for. Each is answered later, or at once with an error.
  /// @{
  void listen(const Envelope& message);
  void connect(const Envelope& message);
  void send(const Envelope& message);
  void receive(const Envelope& message);
  /// Ends the connection in good order: what receives is answered with TCP_CONNECTION_CLOSED, a send under way goes on,
  /// and the answer waits until both sides have closed. With `abort` the answer comes at once.
  void close(const Envelope& message);
  /// @}

  /// Whether close() would be answered at once.
  bool closesAtOnce(bool abort) const;

  /// What close() does then; all that is under way is answered with an error.
  void closeAtOnce(bool abort);

  /// A client has come to this listening endpoint.
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
  bool said_goodbye_ = false;       ///< we have closed our side
  bool other_side_closed_ = false;  ///< and they theirs
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_TCP_ENDPOINT_H
