/// @file datagram_socket.h
#ifndef AIBO_DRIVER_CLIENT_DATAGRAM_SOCKET_H
#define AIBO_DRIVER_CLIENT_DATAGRAM_SOCKET_H

#include <netinet/in.h>
#include <sys/socket.h>

#include <cstddef>
#include <cstdint>
#include <optional>

#include "client/file_descriptor.h"

namespace aibo_driver {

/// Receives datagrams from the other end of a TCP connection.
class DatagramSocket {
 public:
  enum class Origin { kPeer, kForeign };

  /// Takes a free port, at the address of this computer that the connection uses.
  /// @param connection a connected socket
  /// @return false if the kernel refuses
  bool open(int connection);

  void close() noexcept { socket_.close(); }
  bool isOpen() const { return socket_.valid(); }

  /// -1 if it is not open.
  int descriptor() const { return socket_.get(); }

  /// The port that was taken; 0 if it is not open.
  int port() const;

  /// Takes the next datagram, without waiting.
  /// @param[out] size bytes written to buffer; those that do not fit are lost
  /// @return who sent it, the connection's peer or somebody else; nothing if no datagram has come
  std::optional<Origin> receive(std::uint8_t* buffer, std::size_t capacity, std::size_t* size);

  /// Sends a datagram to the sender of the last one received. It may be lost.
  void reply(const std::uint8_t* data, std::size_t size) const;

 private:
  bool isPeer(const sockaddr_storage& sender) const;

  FileDescriptor socket_;
  sockaddr_storage peer_ = {};
  sockaddr_storage sender_ = {};
  socklen_t sender_size_ = 0;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_DATAGRAM_SOCKET_H
