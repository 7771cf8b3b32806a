#include "simulator/openr_host/ip_stack/socket.h"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <chrono>
#include <stdexcept>

IPAddress::IPAddress(const char* text) : address_(0) {
  in_addr parsed{};
  if (inet_pton(AF_INET, text, &parsed) == 1) {
    address_ = ntohl(parsed.s_addr);
  }
}

char* IPAddress::GetAsString(char* text) const {
  const in_addr system{htonl(address_)};
  inet_ntop(AF_INET, &system, text, INET_ADDRSTRLEN);
  return text;
}

namespace openr_host {
namespace {

/// How long the other side may leave something unanswered before it counts as vanished.
constexpr std::chrono::milliseconds kPatience{2000};

bool setOption(int fd, int level, int name, int value) {
  return setsockopt(fd, level, name, &value, sizeof(value)) == 0;
}

}  // namespace

sockaddr_in SocketAddress::system() const {
  sockaddr_in system{};
  system.sin_family = AF_INET;
  system.sin_port = htons(port);
  system.sin_addr.s_addr = htonl(address.Address());
  return system;
}

SocketAddress SocketAddress::ofSocket(int socket) {
  sockaddr_in system{};
  socklen_t size = sizeof(system);
  getsockname(socket, reinterpret_cast<sockaddr*>(&system), &size);
  return SocketAddress(system);
}

SocketAddress SocketAddress::parse(const std::string& address, Port port) {
  in_addr parsed{};
  if (inet_pton(AF_INET, address.c_str(), &parsed) != 1) {
    throw std::invalid_argument(
        "'" + address + "' is not an IPv4 address of this computer, such as 127.0.0.1, or 0.0.0.0 for all of them");
  }
  return {IPAddress(ntohl(parsed.s_addr)), port};
}

bool configureTcpConnection(int socket) {
  // Without TCP_NODELAY, a reply would wait for the acknowledgement of the previous one.
  return setOption(socket, IPPROTO_TCP, TCP_NODELAY, 1) &&
         // A client that is off or out of reach sends nothing. So the kernel probes the client every second, and waits
         // at most kPatience for an acknowledgement.
         setOption(socket, SOL_SOCKET, SO_KEEPALIVE, 1) && setOption(socket, IPPROTO_TCP, TCP_KEEPIDLE, 1) &&
         setOption(socket, IPPROTO_TCP, TCP_KEEPINTVL, 1) && setOption(socket, IPPROTO_TCP, TCP_KEEPCNT, 2) &&
         setOption(socket, IPPROTO_TCP, TCP_USER_TIMEOUT, static_cast<int>(kPatience.count()));
}

}  // namespace openr_host
