/// @file sockets.h
/// Sockets over IPv4 for test servers, clients and proxies. Errors are thrown as std::system_error.
#ifndef TEST_SUPPORT_SOCKETS_H
#define TEST_SUPPORT_SOCKETS_H

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "host_files/file_descriptor.h"

namespace test_support {

using Bytes = std::vector<std::uint8_t>;
using TimePoint = std::chrono::steady_clock::time_point;

/// Bytes. So small that few pictures grow stale in the test apparatus itself.
constexpr int kSmallBuffer = 16 * 1024;

/// @throw std::system_error with what errno says, unless `good`
inline void check(bool good, const std::string& what) {
  if (!good) {
    throw std::system_error(errno, std::generic_category(), what);
  }
}

inline sockaddr_in addressOf(const std::string& address, int port) {
  sockaddr_in parsed = {};
  parsed.sin_family = AF_INET;
  parsed.sin_port = htons(static_cast<std::uint16_t>(port));
  if (::inet_pton(AF_INET, address.c_str(), &parsed.sin_addr) != 1) {
    throw std::invalid_argument("'" + address + "' is not an IPv4 address such as 127.0.0.1");
  }
  return parsed;
}

inline void setOption(const host_files::FileDescriptor& socket, int level, int name, int value) {
  check(::setsockopt(socket.get(), level, name, &value, sizeof value) == 0, "setsockopt");
}

/// A TCP socket that does not block.
/// @param buffer_size bytes that the kernel may hold in each direction; 0 = the kernel's default
inline host_files::FileDescriptor makeSocket(int buffer_size) {
  host_files::FileDescriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  check(socket.valid(), "socket");
  setOption(socket, IPPROTO_TCP, TCP_NODELAY, 1);
  if (buffer_size > 0) {
    setOption(socket, SOL_SOCKET, SO_RCVBUF, buffer_size);
    setOption(socket, SOL_SOCKET, SO_SNDBUF, buffer_size);
  }
  return socket;
}

/// Binds a socket to an address of this computer.
/// @return false if the address is not free
inline bool tryToBind(const host_files::FileDescriptor& socket, const std::string& address, int port) {
  const sockaddr_in parsed = addressOf(address, port);
  return ::bind(socket.get(), reinterpret_cast<const sockaddr*>(&parsed), sizeof parsed) == 0;
}

/// A TCP socket that is bound to an address of this computer, and does not listen yet. It does not block.
/// @param port 0 = any free one below 32768. The kernel gives ROS nodes ports from there up, and the master goes on
///   sending messages to a node that was killed.
/// @param buffer_size as for makeSocket()
inline host_files::FileDescriptor bindTo(const std::string& address, int port, int buffer_size = kSmallBuffer) {
  static std::mt19937 random(std::random_device{}());
  host_files::FileDescriptor socket = makeSocket(buffer_size);
  // A port that another test keeps is not free, although nothing listens there.
  setOption(socket, SOL_SOCKET, SO_REUSEADDR, port != 0 ? 1 : 0);
  bool bound = port != 0 && tryToBind(socket, address, port);
  for (int attempt = 0; port == 0 && !bound && attempt < 100; ++attempt) {
    bound = tryToBind(socket, address, std::uniform_int_distribution<int>(20000, 32767)(random));
  }
  check(bound, address + ":" + std::to_string(port));
  setOption(socket, SOL_SOCKET, SO_REUSEADDR, 1);
  return socket;
}

/// The port that a socket is bound to.
inline int portOf(const host_files::FileDescriptor& socket) {
  sockaddr_in address = {};
  socklen_t size = sizeof address;
  check(::getsockname(socket.get(), reinterpret_cast<sockaddr*>(&address), &size) == 0, "getsockname");
  return ntohs(address.sin_port);
}

/// A socket that is being connected; it does not block.
/// @param buffer_size as for makeSocket()
/// @param from its own address; empty = any
inline host_files::FileDescriptor beginConnecting(const std::string& address, int port, int buffer_size = kSmallBuffer,
                                                  const std::string& from = "") {
  const sockaddr_in parsed = addressOf(address, port);
  host_files::FileDescriptor socket = makeSocket(buffer_size);
  check(from.empty() || tryToBind(socket, from, 0), from);
  const int result = ::connect(socket.get(), reinterpret_cast<const sockaddr*>(&parsed), sizeof parsed);
  check(result == 0 || errno == EINPROGRESS, "connect to " + address);
  return socket;
}

/// Takes the next client of a listening socket; its socket does not block.
/// @return no descriptor if there is none
inline host_files::FileDescriptor acceptFrom(const host_files::FileDescriptor& listener) {
  host_files::FileDescriptor socket(::accept4(listener.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (socket.valid()) {
    setOption(socket, IPPROTO_TCP, TCP_NODELAY, 1);
  }
  return socket;
}

/// Waits until a socket is ready for this, or has ended.
/// @param events POLLIN or POLLOUT
/// @return false if it is not within this time
inline bool isReady(const host_files::FileDescriptor& socket, short events, std::chrono::nanoseconds time) {
  pollfd polled = {socket.get(), events, 0};
  const auto count = std::max<std::chrono::nanoseconds::rep>(time.count(), 0);
  const timespec timeout = {count / 1000000000, count % 1000000000};
  return ::ppoll(&polled, 1, &timeout, nullptr) > 0;
}

/// Sends all bytes.
/// @param may_wait asked again and again while the other side does not read
/// @return false, with errno, if the connection has ended; also if it may not wait
template <typename MayWait>
bool sendAll(const host_files::FileDescriptor& socket, const std::uint8_t* bytes, std::size_t size,
             const MayWait& may_wait) {
  while (size > 0) {
    const ssize_t sent = ::send(socket.get(), bytes, size, MSG_NOSIGNAL);
    if (sent < 0 && (errno != EAGAIN || !may_wait())) {
      return false;
    }
    if (sent < 0) {
      isReady(socket, POLLOUT, std::chrono::milliseconds(10));
      continue;
    }
    bytes += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

/// From now on, closing the socket resets the connection.
inline void resetWhenClosed(const host_files::FileDescriptor& socket) {
  const linger discard = {1, 0};
  ::setsockopt(socket.get(), SOL_SOCKET, SO_LINGER, &discard, sizeof discard);
}

}  // namespace test_support

#endif  // TEST_SUPPORT_SOCKETS_H
