#include "support/sockets.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <system_error>

using host_files::FileDescriptor;

namespace test_support {
namespace {

// Small, so that few pictures grow stale in the test apparatus itself.
constexpr int kBufferSize = 16 * 1024;

sockaddr_in parse(const std::string& address, int port) {
  sockaddr_in parsed = {};
  parsed.sin_family = AF_INET;
  parsed.sin_port = htons(static_cast<std::uint16_t>(port));
  if (::inet_pton(AF_INET, address.c_str(), &parsed.sin_addr) != 1) {
    throw std::invalid_argument("'" + address + "' is not an IPv4 address such as 127.0.0.1");
  }
  return parsed;
}

void setOption(int socket, int level, int name, int value) {
  check(::setsockopt(socket, level, name, &value, sizeof value) == 0, "setsockopt");
}

// The kernel picks free ports from 32768 up. A ROS node that was killed may have had such a port, and the master goes
// on sending messages there.
std::uint16_t portThatNoNodeHasHad() {
  static std::mt19937 random(std::random_device{}());
  return std::uniform_int_distribution<std::uint16_t>(20000, 32767)(random);
}

bool bindOnce(const FileDescriptor& socket, const sockaddr_in& address) {
  return ::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
}

void configure(const FileDescriptor& socket) {
  setOption(socket.get(), IPPROTO_TCP, TCP_NODELAY, 1);
  setOption(socket.get(), SOL_SOCKET, SO_RCVBUF, kBufferSize);
  setOption(socket.get(), SOL_SOCKET, SO_SNDBUF, kBufferSize);
}

}  // namespace

void check(bool good, const std::string& what) {
  if (!good) {
    throw std::system_error(errno, std::generic_category(), what);
  }
}

void bindSocket(const FileDescriptor& socket, const std::string& address, int port) {
  sockaddr_in parsed = parse(address, port);
  // A port that another test keeps is not free, although nothing listens there.
  setOption(socket.get(), SOL_SOCKET, SO_REUSEADDR, port != 0 ? 1 : 0);
  bool bound = port != 0 && bindOnce(socket, parsed);
  for (int attempt = 0; port == 0 && !bound && attempt < 100; ++attempt) {
    parsed.sin_port = htons(portThatNoNodeHasHad());
    bound = bindOnce(socket, parsed);
  }
  check(bound, address + ":" + std::to_string(port));
  setOption(socket.get(), SOL_SOCKET, SO_REUSEADDR, 1);
}

FileDescriptor bindTo(const std::string& address, int port) {
  FileDescriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  check(socket.valid(), "socket");
  configure(socket);
  bindSocket(socket, address, port);
  return socket;
}

int portOf(const FileDescriptor& socket) {
  sockaddr_in address = {};
  socklen_t size = sizeof address;
  check(::getsockname(socket.get(), reinterpret_cast<sockaddr*>(&address), &size) == 0, "getsockname");
  return ntohs(address.sin_port);
}

FileDescriptor beginConnecting(const std::string& address, int port) {
  const sockaddr_in parsed = parse(address, port);
  FileDescriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  check(socket.valid(), "socket");
  configure(socket);
  const int result = ::connect(socket.get(), reinterpret_cast<const sockaddr*>(&parsed), sizeof parsed);
  check(result == 0 || errno == EINPROGRESS, "connect to " + address);
  return socket;
}

FileDescriptor acceptFrom(const FileDescriptor& listener) {
  FileDescriptor socket(::accept4(listener.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (socket.valid()) {
    setOption(socket.get(), IPPROTO_TCP, TCP_NODELAY, 1);
  }
  return socket;
}

void pollUntil(std::vector<pollfd>* polled, std::chrono::steady_clock::time_point end) {
  const std::chrono::nanoseconds left = end - std::chrono::steady_clock::now();
  const auto count = std::max<std::chrono::nanoseconds::rep>(left.count(), 0);
  const timespec timeout = {count / 1000000000, count % 1000000000};
  ::ppoll(polled->data(), polled->size(), &timeout, nullptr);
}

void resetWhenClosed(const FileDescriptor& socket) {
  const linger discard = {1, 0};
  ::setsockopt(socket.get(), SOL_SOCKET, SO_LINGER, &discard, sizeof discard);
}

}  // namespace test_support
