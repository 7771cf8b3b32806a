/// @file socket_address.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_SOCKET_ADDRESS_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_SOCKET_ADDRESS_H

#include <IPAddress.h>
#include <netinet/in.h>

#include <string>

namespace openr_host {

/// An address and a port as OPEN-R counts them.
struct SocketAddress {
  IPAddress address;
  Port port = 0;

  SocketAddress() = default;
  SocketAddress(const IPAddress& address_, Port port_) : address(address_), port(port_) {}
  explicit SocketAddress(const sockaddr_in& system)
      : address(ntohl(system.sin_addr.s_addr)), port(ntohs(system.sin_port)) {}

  /// As the kernel takes them.
  sockaddr_in system() const;

  /// Where a socket of this computer is bound; all 0 if it is not.
  static SocketAddress ofSocket(int socket);

  /// @param address "127.0.0.1", or "0.0.0.0" for all of this computer's
  /// @throw std::invalid_argument if it is no address
  static SocketAddress parse(const std::string& address, Port port);
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_SOCKET_ADDRESS_H
