#include "openr_host/ip_stack/tcp_listener.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <system_error>
#include <thread>

namespace openr_host {
namespace {

/// After this time without an answer a client has vanished.
constexpr std::chrono::milliseconds kPatience{2000};

/// The waiting client wakes the server again at once; nothing but time may bring memory. Shorter than a joint's frame.
constexpr std::chrono::milliseconds kMemoryPause{5};

bool setOption(int fd, int level, int name, int value) {
  return setsockopt(fd, level, name, &value, sizeof(value)) == 0;
}

/// @return false if the kernel cannot
bool configureConnection(int fd) {
  // A reply must not wait for the acknowledgement of the one before it.
  return setOption(fd, IPPROTO_TCP, TCP_NODELAY, 1) &&
         // A client that is switched off or carried away says nothing: ask after it every second, and wait for the
         // acknowledgement of what was sent no longer than kPatience.
         setOption(fd, SOL_SOCKET, SO_KEEPALIVE, 1) && setOption(fd, IPPROTO_TCP, TCP_KEEPIDLE, 1) &&
         setOption(fd, IPPROTO_TCP, TCP_KEEPINTVL, 1) && setOption(fd, IPPROTO_TCP, TCP_KEEPCNT, 2) &&
         setOption(fd, IPPROTO_TCP, TCP_USER_TIMEOUT, static_cast<int>(kPatience.count()));
}

FileDescriptor openSpare() {
  return FileDescriptor(open("/dev/null", O_RDONLY | O_CLOEXEC));
}

sockaddr_in parseAddress(const std::string& address, std::uint16_t port) {
  sockaddr_in parsed{};
  parsed.sin_family = AF_INET;
  parsed.sin_port = htons(port);
  if (inet_pton(AF_INET, address.c_str(), &parsed.sin_addr) != 1) {
    throw std::invalid_argument("'" + address +
                                "' is no IPv4 address of this computer, such as 127.0.0.1, or 0.0.0.0 for all of them");
  }
  return parsed;
}

}  // namespace

TcpListener::TcpListener(const std::string& address, std::uint16_t port)
    : socket_(socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)), spare_(openSpare()) {
  sockaddr_in bound = parseAddress(address, port);
  socklen_t size = sizeof(bound);
  // Else a restarted server would have to wait until the kernel forgets the last one's connections.
  const int reuse = 1;
  if (!socket_.isOpen() || setsockopt(socket_.get(), SOL_SOCKET, SO_REUSEADDR, &reuse, sizeof(reuse)) != 0 ||
      bind(socket_.get(), reinterpret_cast<sockaddr*>(&bound), size) != 0 || listen(socket_.get(), SOMAXCONN) != 0 ||
      getsockname(socket_.get(), reinterpret_cast<sockaddr*>(&bound), &size) != 0) {
    throw std::system_error(errno, std::generic_category(), "listen on port " + std::to_string(port));
  }
  port_ = ntohs(bound.sin_port);
}

std::optional<TcpConnection> TcpListener::accept() {
  for (;;) {
    sockaddr_in client{};
    socklen_t size = sizeof(client);
    FileDescriptor socket(
        accept4(socket_.get(), reinterpret_cast<sockaddr*>(&client), &size, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (socket.isOpen()) {
      if (!configureConnection(socket.get())) {
        continue;  // a client that cannot be told from one that has vanished is let go
      }
      return TcpConnection{std::move(socket), ntohl(client.sin_addr.s_addr), ntohs(client.sin_port)};
    }
    switch (errno) {
      case EAGAIN:
        return std::nullopt;
      case EMFILE:
      case ENFILE:
        turnOneAway();
        return std::nullopt;
      case ENOBUFS:
      case ENOMEM:
        std::this_thread::sleep_for(kMemoryPause);
        return std::nullopt;
      default:  // this client has gone already; perhaps there is another one
        break;
    }
  }
}

void TcpListener::turnOneAway() {
  spare_.close();
  FileDescriptor(accept4(socket_.get(), nullptr, nullptr, SOCK_CLOEXEC)).close();
  spare_ = openSpare();
}

}  // namespace openr_host
