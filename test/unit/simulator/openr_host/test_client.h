/// @file test_client.h
#ifndef TEST_UNIT_SIMULATOR_OPENR_HOST_TEST_CLIENT_H
#define TEST_UNIT_SIMULATOR_OPENR_HOST_TEST_CLIENT_H

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "simulator/openr_host/ip_stack/socket.h"

namespace openr_host {

/// A client on this computer. Never waits: the server runs on the same thread.
class TestClient {
 public:
  /// @param receive_buffer bytes the kernel keeps for this client; 0 is its default
  explicit TestClient(std::uint16_t port, int receive_buffer = 0) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    if (receive_buffer > 0) {
      setsockopt(socket_.get(), SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof(receive_buffer));
    }
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    // The kernel connects without the server as long as there is room in the listener's backlog.
    if (connect(socket_.get(), reinterpret_cast<sockaddr*>(&address), sizeof(address)) != 0) {
      throw std::runtime_error("the test client cannot connect");
    }
  }

  std::uint16_t port() const {
    sockaddr_in address{};
    socklen_t size = sizeof(address);
    getsockname(socket_.get(), reinterpret_cast<sockaddr*>(&address), &size);
    return ntohs(address.sin_port);
  }

  void send(const std::string& text) {
    if (::send(socket_.get(), text.data(), text.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(text.size())) {
      throw std::runtime_error("the test client cannot send");
    }
  }

  /// All bytes received so far.
  const std::string& received() {
    char part[65536];
    for (;;) {
      const ssize_t count = recv(socket_.get(), part, sizeof(part), MSG_DONTWAIT);
      if (count > 0) {
        received_.append(part, static_cast<std::size_t>(count));
        continue;
      }
      at_end_ = at_end_ || count == 0;
      was_reset_ = was_reset_ || (count < 0 && errno == ECONNRESET);
      return received_;
    }
  }

  /// True if the server has closed the connection and everything it sent has arrived.
  bool isAtEnd() {
    received();
    return at_end_;
  }

  bool wasReset() {
    received();
    return was_reset_;
  }

  void close() { socket_.close(); }

  /// Stops sending, but still reads.
  void finishSending() { shutdown(socket_.get(), SHUT_WR); }

  void reset() {
    const linger hard{1, 0};
    setsockopt(socket_.get(), SOL_SOCKET, SO_LINGER, &hard, sizeof(hard));
    socket_.close();
  }

 private:
  FileDescriptor socket_;
  std::string received_;
  bool at_end_ = false;
  bool was_reset_ = false;
};

}  // namespace openr_host

#endif  // TEST_UNIT_SIMULATOR_OPENR_HOST_TEST_CLIENT_H
