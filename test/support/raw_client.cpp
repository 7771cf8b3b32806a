#include "support/raw_client.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>

#include "support/sockets.h"

using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace test_support {

RawClient::RawClient(int port) : socket_(beginConnecting("127.0.0.1", port)) {
  pollfd polled = {socket_.get(), POLLOUT, 0};
  ::poll(&polled, 1, 5000);
  int error = 0;
  socklen_t size = sizeof error;
  ::getsockopt(socket_.get(), SOL_SOCKET, SO_ERROR, &error, &size);
  errno = error;
  check(error == 0 || error == ECONNRESET, "connect");  // a reset may already have come
}

bool RawClient::send(const std::string& bytes) {
  return ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL) >= 0 || errno == EAGAIN;
}

std::optional<Bytes> RawClient::receive(milliseconds timeout, std::size_t most) {
  pollfd polled = {socket_.get(), POLLIN, 0};
  if (::poll(&polled, 1, static_cast<int>(timeout.count())) <= 0) {
    return std::nullopt;
  }
  Bytes bytes(most);
  const ssize_t count = ::recv(socket_.get(), bytes.data(), bytes.size(), 0);
  bytes.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return bytes;
}

Bytes RawClient::read(std::size_t size, milliseconds timeout) {
  const TimePoint end = steady_clock::now() + timeout;
  Bytes bytes;
  while (bytes.size() < size && steady_clock::now() < end) {
    const auto left = std::chrono::ceil<milliseconds>(end - steady_clock::now());
    const auto part = receive(std::max(left, milliseconds(0)), size - bytes.size());
    if (!part || part->empty()) {
      break;
    }
    bytes.insert(bytes.end(), part->begin(), part->end());
  }
  return bytes;
}

void RawClient::reset() {
  resetWhenClosed(socket_);
  socket_.close();
}

}  // namespace test_support
