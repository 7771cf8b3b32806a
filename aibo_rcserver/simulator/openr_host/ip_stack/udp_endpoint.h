/// @file udp_endpoint.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_UDP_ENDPOINT_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_UDP_ENDPOINT_H

#include <UDPEndpointMsg.h>

#include <string>

#include "simulator/openr_host/ip_stack/endpoint.h"
#include "simulator/openr_host/ip_stack/socket.h"

namespace openr_host {

/// The states are: new; bound, perhaps connected; closed (OPEN-R SDK Internet Protocol Version4, figure 5).
class UdpEndpoint : public Endpoint {
 public:
  static constexpr UDPEndpointError kOperationInvalid = UDP_OPERATION_INVALID;
  static constexpr UDPEndpointError kBufferInvalid = UDP_BUFFER_INVALID;

  /// @param pool_size the size of the socket's send buffer, in bytes
  /// @param deliver must outlive the object
  UdpEndpoint(int pool_size, const Deliver& deliver);

  /// The requests below are answered at once.
  /// @param bind_address an address of this computer
  /// @param host_port the port of this computer that stands for the robot's; 0 if the robot's may be any
  void bind(UDPEndpointBindMsg& message, const std::string& bind_address, Port host_port);
  void close(UDPEndpointCloseMsg& message);

  /// The requests below are answered later, or at once with an error.
  void send(const Envelope& message);
  void receive(const Envelope& message);

  bool isClosed() const override { return is_closed_; }
  bool uses(const std::function<bool(const void*, std::size_t)>& is_concerned) const override;
  void addTo(PollSet& poll_set) override;

 private:
  template <typename Message>
  bool mayBegin(const PendingMessage<Message>& under_way, const Envelope& message) const;
  void goOnSending();
  void goOnReceiving();

  const int pool_size_;
  const Deliver& deliver_;
  FileDescriptor socket_;  ///< open from bind() to close()
  bool is_closed_ = false;
  PendingMessage<UDPEndpointSendMsg> sending_;
  PendingMessage<UDPEndpointReceiveMsg> receiving_;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_UDP_ENDPOINT_H
