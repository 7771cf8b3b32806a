#include "client/datagram_socket.h"

#include <cstring>
#include <utility>

namespace aibo_client {
namespace {

// Enough for two of the largest pictures. The kernel may allow less.
constexpr int kDatagramBufferSize = 512 * 1024;

sockaddr* asAddress(sockaddr_storage* storage) {
  return reinterpret_cast<sockaddr*>(storage);
}

/// The port in an IPv4 or IPv6 address.
in_port_t& portIn(sockaddr_storage* address) {
  return address->ss_family == AF_INET6 ? reinterpret_cast<sockaddr_in6*>(address)->sin6_port
                                        : reinterpret_cast<sockaddr_in*>(address)->sin_port;
}

}  // namespace

bool DatagramSocket::open(int connection) {
  close();
  sockaddr_storage own = {};
  socklen_t own_size = sizeof own;
  socklen_t peer_size = sizeof peer_;
  if (::getsockname(connection, asAddress(&own), &own_size) != 0 ||
      ::getpeername(connection, asAddress(&peer_), &peer_size) != 0) {
    return false;
  }
  portIn(&own) = 0;
  host_files::FileDescriptor socket(::socket(own.ss_family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!socket.valid() || ::bind(socket.get(), asAddress(&own), own_size) != 0 ||
      ::getsockname(socket.get(), asAddress(&own), &own_size) != 0) {
    return false;
  }
  ::setsockopt(socket.get(), SOL_SOCKET, SO_RCVBUF, &kDatagramBufferSize, sizeof kDatagramBufferSize);
  socket_ = std::move(socket);
  port_ = ntohs(portIn(&own));
  return true;
}

std::optional<DatagramSocket::Origin> DatagramSocket::receive(std::uint8_t* buffer, std::size_t capacity,
                                                              std::size_t* size) {
  if (!isOpen()) {
    return std::nullopt;
  }
  sender_size_ = sizeof sender_;
  const ssize_t count = ::recvfrom(socket_.get(), buffer, capacity, 0, asAddress(&sender_), &sender_size_);
  if (count < 0) {
    return std::nullopt;
  }
  *size = static_cast<std::size_t>(count);
  return isPeer(sender_) ? Origin::kPeer : Origin::kForeign;
}

void DatagramSocket::reply(const std::uint8_t* data, std::size_t size) const {
  ::sendto(socket_.get(), data, size, MSG_NOSIGNAL, reinterpret_cast<const sockaddr*>(&receiver_), receiver_size_);
}

// The sender's port does not matter, because the robot chooses it.
bool DatagramSocket::isPeer(const sockaddr_storage& sender) const {
  if (sender.ss_family != peer_.ss_family) {
    return false;
  }
  if (sender.ss_family == AF_INET6) {
    return std::memcmp(&reinterpret_cast<const sockaddr_in6&>(sender).sin6_addr,
                       &reinterpret_cast<const sockaddr_in6&>(peer_).sin6_addr, sizeof(in6_addr)) == 0;
  }
  return reinterpret_cast<const sockaddr_in&>(sender).sin_addr.s_addr ==
         reinterpret_cast<const sockaddr_in&>(peer_).sin_addr.s_addr;
}

}  // namespace aibo_client
