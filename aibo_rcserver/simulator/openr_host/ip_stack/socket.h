/// @file socket.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_SOCKET_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_SOCKET_H

#include <IPAddress.h>
#include <netinet/in.h>
#include <unistd.h>

#include <string>
#include <utility>

namespace openr_host {

class FileDescriptor {
 public:
  FileDescriptor() = default;
  explicit FileDescriptor(int fd) : fd_(fd) {}
  ~FileDescriptor() { close(); }
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    if (this != &other) {
      close();
      fd_ = std::exchange(other.fd_, -1);
    }
    return *this;
  }

  int get() const { return fd_; }
  bool isOpen() const { return fd_ >= 0; }
  void close() {
    if (fd_ >= 0) {
      ::close(std::exchange(fd_, -1));
    }
  }

 private:
  int fd_ = -1;
};

/// An address and a port in OPEN-R's types.
struct SocketAddress {
  IPAddress address;
  Port port = 0;

  SocketAddress() = default;
  SocketAddress(const IPAddress& address_, Port port_) : address(address_), port(port_) {}
  explicit SocketAddress(const sockaddr_in& system)
      : address(ntohl(system.sin_addr.s_addr)), port(ntohs(system.sin_port)) {}

  /// The same in the kernel's format.
  sockaddr_in system() const;

  /// The socket's own address; all 0 if it has none.
  static SocketAddress ofSocket(int socket);

  /// @param address "127.0.0.1", or "0.0.0.0" for all addresses of this computer
  /// @throw std::invalid_argument the text is not an address
  static SocketAddress parse(const std::string& address, Port port);
};

/// Makes a connected socket send at once, and notice within about 2 s that the other side has vanished.
/// @return false if the kernel refuses
bool configureTcpConnection(int socket);

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_SOCKET_H
