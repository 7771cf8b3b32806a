#include "simulator/openr_host/ip_stack/tcp_listener.h"

#include <netinet/in.h>
#include <sys/socket.h>

#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>

#include "simulator/openr_host/ip_stack/socket.h"

namespace openr_host {
namespace {

/// The pause before another attempt if there is no descriptor or memory; without it, the waiting client would wake the
/// server at once. The pause is shorter than a frame.
constexpr std::chrono::milliseconds kPause{5};

}  // namespace

TcpListener::TcpListener(const std::string& address, std::uint16_t port)
    : socket_(socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
  const sockaddr_in bound = SocketAddress::parse(address, port).system();
  // Without SO_REUSEADDR, a restarted server would wait until the kernel forgets its last connections.
  const int reuse = 1;
  if (!socket_.isOpen() || setsockopt(socket_.get(), SOL_SOCKET, SO_REUSEADDR, &reuse, sizeof(reuse)) != 0 ||
      bind(socket_.get(), reinterpret_cast<const sockaddr*>(&bound), sizeof(bound)) != 0 ||
      listen(socket_.get(), SOMAXCONN) != 0) {
    throw std::system_error(errno, std::generic_category(), "listen on port " + std::to_string(port));
  }
  port_ = SocketAddress::ofSocket(socket_.get()).port;
}

std::optional<TcpConnection> TcpListener::accept() {
  for (;;) {
    sockaddr_in client{};
    socklen_t size = sizeof(client);
    FileDescriptor socket(
        accept4(socket_.get(), reinterpret_cast<sockaddr*>(&client), &size, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (socket.isOpen()) {
      if (!configureTcpConnection(socket.get())) {
        continue;  // without these options nobody would notice a vanished client
      }
      return TcpConnection{std::move(socket), SocketAddress(client)};
    }
    switch (errno) {
      case EAGAIN:
        return std::nullopt;
      case EMFILE:
      case ENFILE:
      case ENOBUFS:
      case ENOMEM:
        std::this_thread::sleep_for(kPause);
        return std::nullopt;
      default:  // this client has gone already; try the next one
        break;
    }
  }
}

}  // namespace openr_host
