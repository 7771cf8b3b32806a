/// @file tcp_listener.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_TCP_LISTENER_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_TCP_LISTENER_H

#include <cstdint>
#include <optional>
#include <string>

#include "simulator/openr_host/ip_stack/socket.h"

namespace openr_host {

/// A new client.
struct TcpConnection {
  FileDescriptor socket;  ///< non-blocking, sends at once, notices within about 2 s that the client has vanished
  SocketAddress client;
};

class TcpListener {
 public:
  /// @param address an address of this computer; "0.0.0.0" means all of them
  /// @param port 0 means any free port
  /// @throw std::system_error the port is in use or not allowed
  /// @throw std::invalid_argument the text is not an address
  TcpListener(const std::string& address, std::uint16_t port);

  int fd() const { return socket_.get(); }
  std::uint16_t port() const { return port_; }

  /// The next client that waits, if there is one. It goes on waiting if there is no free descriptor or memory.
  std::optional<TcpConnection> accept();

 private:
  FileDescriptor socket_;
  std::uint16_t port_ = 0;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_TCP_LISTENER_H
