/// @file udp_socket.h
/// A UDP socket of this computer that never waits, for tests.
#ifndef TEST_SUPPORT_UDP_SOCKET_H
#define TEST_SUPPORT_UDP_SOCKET_H

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "support/sockets.h"

namespace test_support {

class UdpSocket {
 public:
  /// @param address of this computer; Linux has all of 127.0.0.0/8
  /// @param port 0: any that is free
  explicit UdpSocket(const std::string& address = "127.0.0.1", int port = 0)
      : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    check(tryToBind(socket_, address, port), "bind");
  }

  std::uint16_t port() const { return static_cast<std::uint16_t>(portOf(socket_)); }

  void send(int port, const std::vector<std::uint8_t>& bytes, const std::string& address = "127.0.0.1") {
    sendTo(addressOf(address, port), bytes);
  }

  /// Sends to the sender of the last datagram of next().
  void reply(const std::vector<std::uint8_t>& bytes) { sendTo(sender_, bytes); }

  /// The port of the sender of the last datagram of next().
  std::uint16_t senderPort() const { return ntohs(sender_.sin_port); }

  /// The next datagram, if it is here already.
  std::optional<std::vector<std::uint8_t>> next() {
    std::vector<std::uint8_t> bytes(65536);
    socklen_t sender_size = sizeof(sender_);
    const ssize_t size = ::recvfrom(socket_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT,
                                    reinterpret_cast<sockaddr*>(&sender_), &sender_size);
    if (size < 0) {
      return std::nullopt;
    }
    bytes.resize(static_cast<std::size_t>(size));
    return bytes;
  }

 private:
  void sendTo(const sockaddr_in& to, const std::vector<std::uint8_t>& bytes) {
    ::sendto(socket_.get(), bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof(to));
  }

  host_files::FileDescriptor socket_;
  sockaddr_in sender_{};
};

}  // namespace test_support

#endif  // TEST_SUPPORT_UDP_SOCKET_H
