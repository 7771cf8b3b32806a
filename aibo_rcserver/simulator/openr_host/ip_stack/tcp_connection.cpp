#include "simulator/openr_host/ip_stack/tcp_connection.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <chrono>

namespace openr_host {
namespace {

/// After this time without an answer the other side has vanished.
constexpr std::chrono::milliseconds kPatience{2000};

bool setOption(int fd, int level, int name, int value) {
  return setsockopt(fd, level, name, &value, sizeof(value)) == 0;
}

}  // namespace

bool configureTcpConnection(int socket) {
  // A reply must not wait for the acknowledgement of the one before it.
  return setOption(socket, IPPROTO_TCP, TCP_NODELAY, 1) &&
         // A client that is switched off or carried away says nothing: ask after it every second, and wait for the
         // acknowledgement of what was sent no longer than kPatience.
         setOption(socket, SOL_SOCKET, SO_KEEPALIVE, 1) && setOption(socket, IPPROTO_TCP, TCP_KEEPIDLE, 1) &&
         setOption(socket, IPPROTO_TCP, TCP_KEEPINTVL, 1) && setOption(socket, IPPROTO_TCP, TCP_KEEPCNT, 2) &&
         setOption(socket, IPPROTO_TCP, TCP_USER_TIMEOUT, static_cast<int>(kPatience.count()));
}

}  // namespace openr_host
