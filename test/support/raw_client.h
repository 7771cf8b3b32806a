/// @file raw_client.h
#ifndef TEST_SUPPORT_RAW_CLIENT_H
#define TEST_SUPPORT_RAW_CLIENT_H

#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <chrono>
#include <optional>
#include <string>

#include "support/proxy/fault.h"
#include "support/sockets.h"

namespace test_support {

/// A client that sends and reads exactly what a test asks for. What it does not read stays in the kernel; see
/// TestClient for one that always reads everything.
class RawClient {
 public:
  using milliseconds = std::chrono::milliseconds;

  /// Connects to a port of 127.0.0.1, with small buffers, like the driver.
  /// @throw std::system_error
  explicit RawClient(int port) : socket_(beginConnecting("127.0.0.1", port)) {
    pollfd polled = {socket_.get(), POLLOUT, 0};
    ::poll(&polled, 1, 5000);
    int error = 0;
    socklen_t size = sizeof error;
    ::getsockopt(socket_.get(), SOL_SOCKET, SO_ERROR, &error, &size);
    errno = error;
    check(error == 0 || error == ECONNRESET, "connect");  // a reset may already have come
  }

  /// Sends as much as the kernel takes now.
  /// @return false if the connection has ended
  bool send(const std::string& bytes) {
    return ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL) >= 0 || errno == EAGAIN;
  }

  /// Reads the bytes that are there, and waits for the first one.
  /// @param most most bytes to read
  /// @return nothing if none came in time; no bytes if the connection has ended
  std::optional<Bytes> receive(milliseconds timeout, std::size_t most = 65536) {
    pollfd polled = {socket_.get(), POLLIN, 0};
    if (::poll(&polled, 1, static_cast<int>(timeout.count())) <= 0) {
      return std::nullopt;
    }
    Bytes bytes(most);
    const ssize_t count = ::recv(socket_.get(), bytes.data(), bytes.size(), 0);
    bytes.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return bytes;
  }

  /// Reads this many bytes.
  /// @return fewer if the connection has ended, or if they did not come in time
  Bytes read(std::size_t size, milliseconds timeout) {
    Bytes bytes;
    for (std::optional<Bytes> part; bytes.size() < size && (part = receive(timeout, size - bytes.size()));) {
      if (part->empty()) {
        break;
      }
      bytes.insert(bytes.end(), part->begin(), part->end());
    }
    return bytes;
  }

 private:
  host_files::FileDescriptor socket_;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_RAW_CLIENT_H
