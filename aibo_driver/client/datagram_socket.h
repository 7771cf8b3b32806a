/// @file datagram_socket.h
#ifndef AIBO_DRIVER_CLIENT_DATAGRAM_SOCKET_H
#define AIBO_DRIVER_CLIENT_DATAGRAM_SOCKET_H

#include <netinet/in.h>
#include <sys/socket.h>

#include <cstddef>
#include <cstdint>
#include <optional>

#include "host_files/file_descriptor.h"

namespace aibo_client {

/// Receives datagrams from the other end of a TCP connection.
class DatagramSocket {
 public:
  enum class Origin { kPeer, kForeign };

  /// Takes a free port at this computer's address in the connection.
  /// @param connection a connected socket
  /// @return false if the kernel refuses, and errno says why
  bool open(int connection);

  void close() noexcept { socket_.close(); }
  bool isOpen() const { return socket_.valid(); }

  /// The descriptor. It is -1 if the socket is not open.
  int descriptor() const { return socket_.get(); }

  /// The port that was taken. It is 0 if the socket is not open.
  int port() const { return isOpen() ? port_ : 0; }

  /// Takes the next datagram, without waiting.
  /// @param[out] size how many bytes were written to buffer; bytes that do not fit are lost
  /// @return who sent it: the connection's peer or somebody else; empty if no datagram has come
  std::optional<Origin> receive(std::uint8_t* buffer, std::size_t capacity, std::size_t* size);

  /// Replies go to the sender of the datagram that was received last, from now on.
  void replyToLastSender() {
    receiver_ = sender_;
    receiver_size_ = sender_size_;
  }

  /// Sends a datagram to the sender that replyToLastSender() has chosen. It may be lost.
  void reply(const std::uint8_t* data, std::size_t size) const;

 private:
  bool isPeer(const sockaddr_storage& sender) const;

  host_files::FileDescriptor socket_;
  int port_ = 0;
  sockaddr_storage peer_ = {};
  sockaddr_storage sender_ = {};
  socklen_t sender_size_ = 0;
  sockaddr_storage receiver_ = {};
  socklen_t receiver_size_ = 0;
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_DATAGRAM_SOCKET_H
