#include "simulator/openr_host/ip_stack/udp_endpoint.h"

#include <sys/socket.h>

#include <cerrno>
#include <utility>

#include "simulator/openr_host/ip_stack/socket.h"

namespace openr_host {
namespace {

UDPEndpointError udpErrorOf(int error) {
  static const std::map<int, UDPEndpointError> kUdpErrors = {{EADDRINUSE, UDP_ADDRESSINUSE},
                                                             {EADDRNOTAVAIL, UDP_ADDRESSERROR},
                                                             {EACCES, UDP_ADDRESSERROR},
                                                             {EINVAL, UDP_ADDRESSERROR},
                                                             {ECONNREFUSED, UDP_PORT_UNREACHABLE},
                                                             {EHOSTUNREACH, UDP_HOST_UNREACHABLE},
                                                             {ENETUNREACH, UDP_NETWORK_UNREACHABLE},
                                                             {EMSGSIZE, UDP_MESSAGE_TOO_LONG}};
  return errorOf(error, kUdpErrors, UDP_FAIL);
}

}  // namespace

UdpEndpoint::UdpEndpoint(int pool_size, const Deliver& deliver)
    : pool_size_(pool_size), deliver_(deliver), sending_(deliver), receiving_(deliver) {}

void UdpEndpoint::bind(UDPEndpointBindMsg& message, const std::string& bind_address, Port host_port) {
  if (socket_.isOpen()) {
    message.error = UDP_OPERATION_INVALID;
    return;
  }
  FileDescriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const sockaddr_in local = SocketAddress::parse(bind_address, host_port).system();
  if (!socket.isOpen() || ::bind(socket.get(), reinterpret_cast<const sockaddr*>(&local), sizeof(local)) != 0) {
    message.error = udpErrorOf(errno);
    return;
  }
  setsockopt(socket.get(), SOL_SOCKET, SO_SNDBUF, &pool_size_, sizeof(pool_size_));
  socket_ = std::move(socket);
  const auto bound = SocketAddress::ofSocket(socket_.get());
  message.address = bound.address;
  message.port = message.port == IP_PORT_ANY ? bound.port : message.port;
  message.error = UDP_SUCCESS;
}

void UdpEndpoint::close(UDPEndpointCloseMsg& message) {
  receiving_.end(UDP_CONNECTION_CLOSED);
  sending_.end(UDP_CONNECTION_CLOSED);
  socket_.close();
  is_closed_ = true;
  message.error = UDP_SUCCESS;
}

template <typename Message>
bool UdpEndpoint::mayBegin(const PendingMessage<Message>& under_way, const Envelope& message) const {
  if (!socket_.isOpen() || under_way) {
    answer<Message>(deliver_, message, under_way ? UDP_CONNECTION_BUSY : UDP_OPERATION_INVALID);
    return false;
  }
  return true;
}

void UdpEndpoint::send(const Envelope& message) {
  if (mayBegin(sending_, message)) {
    sending_.begin(message);
    goOnSending();
  }
}

void UdpEndpoint::goOnSending() {
  const sockaddr_in foreign = SocketAddress(sending_->address, sending_->port).system();
  const ssize_t count = sendto(socket_.get(), sending_->buffer, sizeOf(sending_->size), MSG_NOSIGNAL | MSG_DONTWAIT,
                               reinterpret_cast<const sockaddr*>(&foreign), sizeof(foreign));
  if (count >= 0) {
    sending_.end(UDP_SUCCESS);
  } else if (!isTransient(errno)) {
    sending_.end(udpErrorOf(errno));
  }
}

void UdpEndpoint::receive(const Envelope& message) {
  if (mayBegin(receiving_, message)) {
    receiving_.begin(message);
    goOnReceiving();
  }
}

void UdpEndpoint::goOnReceiving() {
  sockaddr_in foreign{};
  socklen_t size = sizeof(foreign);
  const ssize_t count = recvfrom(socket_.get(), receiving_->buffer, sizeOf(receiving_->size), MSG_DONTWAIT,
                                 reinterpret_cast<sockaddr*>(&foreign), &size);
  if (count >= 0) {
    const SocketAddress sender(foreign);
    receiving_->address = sender.address;
    receiving_->port = sender.port;
    receiving_->size = static_cast<int>(count);
    receiving_.end(UDP_SUCCESS);
  } else if (!isTransient(errno)) {
    receiving_.end(udpErrorOf(errno));
  }
}

bool UdpEndpoint::uses(const std::function<bool(const void*, std::size_t)>& is_concerned) const {
  return (sending_ && is_concerned(sending_->buffer, sizeOf(sending_->size))) ||
         (receiving_ && is_concerned(receiving_->buffer, sizeOf(receiving_->size)));
}

void UdpEndpoint::addTo(PollSet& poll_set) {
  if (!sending_ && !receiving_) {
    return;
  }
  const int events = (receiving_ ? POLLIN : 0) | (sending_ ? POLLOUT : 0);
  poll_set.add(socket_.get(), static_cast<short>(events), [this] {
    if (receiving_) {
      goOnReceiving();
    }
    if (sending_) {
      goOnSending();
    }
  });
}

}  // namespace openr_host
