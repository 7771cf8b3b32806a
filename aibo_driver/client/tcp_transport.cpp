#include "client/tcp_transport.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/epoll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

#include "aibo_client/callbacks.h"
#include "aibo_client/options.h"
#include "client/fault.h"

namespace aibo_client {

using host_files::FileDescriptor;
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// The buffer is small, so that few pictures can grow stale in the kernel while this process does not read.
constexpr int kReceiveBufferSize = 16 * 1024;
// If a peer vanishes while nothing is due, the kernel notices it after 4 s: 1 s of silence, then 3 unanswered probes.
constexpr int kKeepAliveIdle = 1;      // s
constexpr int kKeepAliveInterval = 1;  // s
constexpr int kKeepAliveCount = 3;
// How long the kernel waits for a request to be acknowledged. After that the connection is broken.
constexpr int kUserTimeout = 2000;  // ms
// While a robot does not answer, another attempt begins at this interval, in addition to those in progress.
constexpr milliseconds kAttemptInterval{250};
constexpr std::size_t kMostAttempts = 8;
// The largest request is the upload of a motion, 64 KiB. All others are a few bytes. If this much is unsent, the peer
// stopped reading long ago.
constexpr std::size_t kMostUnsent = 1024 * 1024;
// The longest sleep (our choice). Orders that become too old are dropped when the thread wakes.
constexpr milliseconds kLongestSleep{250};

std::string describe(int error) {
  return std::generic_category().message(error);
}

void setOption(int socket, int level, int name, int value) {
  if (::setsockopt(socket, level, name, &value, sizeof value) != 0) {
    throw Fault::internal("setsockopt: " + describe(errno));
  }
}

FileDescriptor openSocket(int family) {
  FileDescriptor socket(::socket(family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!socket.valid()) {
    throw Fault::internal("socket: " + describe(errno));
  }
  setOption(socket.get(), IPPROTO_TCP, TCP_NODELAY, 1);
  setOption(socket.get(), SOL_SOCKET, SO_RCVBUF, kReceiveBufferSize);
  setOption(socket.get(), SOL_SOCKET, SO_KEEPALIVE, 1);
  setOption(socket.get(), IPPROTO_TCP, TCP_KEEPIDLE, kKeepAliveIdle);
  setOption(socket.get(), IPPROTO_TCP, TCP_KEEPINTVL, kKeepAliveInterval);
  setOption(socket.get(), IPPROTO_TCP, TCP_KEEPCNT, kKeepAliveCount);
  setOption(socket.get(), IPPROTO_TCP, TCP_USER_TIMEOUT, kUserTimeout);
  return socket;
}

// A socket may connect to itself (TCP's simultaneous open): if no program listens at a port of this computer, the
// kernel may give that very port to the socket.
bool isConnectedToItself(int socket) {
  sockaddr_storage own = {};
  sockaddr_storage peer = {};
  socklen_t own_size = sizeof own;
  socklen_t peer_size = sizeof peer;
  return ::getsockname(socket, reinterpret_cast<sockaddr*>(&own), &own_size) == 0 &&
         ::getpeername(socket, reinterpret_cast<sockaddr*>(&peer), &peer_size) == 0 && own_size == peer_size &&
         std::memcmp(&own, &peer, own_size) == 0;
}

void add(int epoll, int socket, std::size_t index) {
  epoll_event event = {};
  event.events = EPOLLOUT;
  event.data.u64 = index;
  if (::epoll_ctl(epoll, EPOLL_CTL_ADD, socket, &event) != 0) {
    throw Fault::internal("epoll_ctl: " + describe(errno));
  }
}

int pollTimeout(TimePoint deadline) {
  const auto left = std::chrono::ceil<milliseconds>(deadline - steady_clock::now());
  return static_cast<int>(std::clamp(left, milliseconds(0), kLongestSleep).count());
}

}  // namespace

TcpTransport::TcpTransport(Resolver resolver) : name_lookup_(std::move(resolver)) {}

// Begins several attempts, one after the other, and takes the first one that succeeds. They go to the addresses in
// turn, except for those that have failed. The kernel repeats a lost packet only after 1 s, and again after 2 s more.
// That is too slow for a radio link that comes back at once.
void TcpTransport::connect(const std::string& host, int port, TimePoint deadline) {
  const TimePoint begin = steady_clock::now();
  address_ = addressText(host, port);
  const std::vector<SocketAddress> addresses = lookUp(host, port, deadline);
  const FileDescriptor any_attempt(::epoll_create1(EPOLL_CLOEXEC));
  if (!any_attempt.valid()) {
    throw Fault::internal("epoll_create1: " + describe(errno));
  }
  struct Attempt {
    FileDescriptor socket;
    std::size_t address;  // an index
  };
  std::vector<Attempt> attempts;
  std::set<std::size_t> failed;  // addresses
  for (std::size_t next = 0; steady_clock::now() < deadline; ++next) {
    std::size_t address = next % addresses.size();
    if (failed.count(address) != 0) {
      continue;
    }
    TimePoint patience = deadline;
    try {
      if (attempts.size() < kMostAttempts + addresses.size()) {
        attempts.push_back({openSocket(addresses[address].storage.ss_family), address});
        beginToConnect(attempts.back().socket.get(), addresses[address]);
        add(any_attempt.get(), attempts.back().socket.get(), attempts.size() - 1);
        patience = std::min(deadline, steady_clock::now() + kAttemptInterval);
      }
      if (waitFor(any_attempt.get(), POLLIN, patience)) {
        epoll_event event = {};
        ::epoll_wait(any_attempt.get(), &event, 1, 0);
        address = attempts[event.data.u64].address;
        FileDescriptor socket = std::move(attempts[event.data.u64].socket);
        checkConnected(socket.get());
        socket_ = std::move(socket);
        return;
      }
    } catch (const Fault&) {
      failed.insert(address);
      if (failed.size() == addresses.size()) {
        throw;
      }
    }
  }
  throw Fault::noAnswer(address_, std::chrono::round<milliseconds>(deadline - begin));
}

std::vector<SocketAddress> TcpTransport::lookUp(const std::string& host, int port, TimePoint deadline) {
  name_lookup_.start(host, port);
  if (!waitFor(name_lookup_.descriptor(), POLLIN, deadline)) {
    throw Fault::nameNotFound(host, "the name server does not answer");
  }
  const NameLookupResult result = name_lookup_.take();
  if (!result.problem.empty()) {
    throw Fault::nameNotFound(host, result.problem);
  }
  return result.addresses;
}

void TcpTransport::beginToConnect(int socket, const SocketAddress& address) const {
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&address.storage), address.size) != 0 &&
      errno != EINPROGRESS) {
    throwFault(errno);
  }
}

void TcpTransport::checkConnected(int socket) const {
  int error = 0;
  socklen_t size = sizeof error;
  ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size);
  if (error == ECONNRESET) {
    throw Fault::turnedAway(address_);  // the peer accepted the connection, and reset it before this thread looked
  }
  if (error != 0) {
    throwFault(error);
  }
  if (isConnectedToItself(socket)) {
    const linger discard = {1, 0};  // leaves no trace that would keep a server from using the port
    ::setsockopt(socket, SOL_SOCKET, SO_LINGER, &discard, sizeof discard);
    throw Fault::refused(address_);
  }
}

TcpTransport::Readable TcpTransport::wait(TimePoint deadline) {
  const auto [connection, datagrams] =
      pollOnce(socket_.get(), hasUnsent() ? POLLIN | POLLOUT : POLLIN, deadline, datagrams_.descriptor());
  if ((connection & POLLOUT) != 0) {
    sendOn();
  }
  return {(connection & ~POLLOUT) != 0, datagrams != 0};
}

std::size_t TcpTransport::receive(std::uint8_t* buffer, std::size_t capacity) {
  const ssize_t count = ::recv(socket_.get(), buffer, capacity, 0);
  if (count > 0) {
    return static_cast<std::size_t>(count);
  }
  if (count == 0) {
    throw Fault::closed(address_);
  }
  if (errno == EAGAIN || errno == EINTR) {
    return 0;
  }
  throwFault(errno);
}

void TcpTransport::send(const std::uint8_t* data, std::size_t size) {
  unsent_.insert(unsent_.end(), data, data + size);
  sendOn();
  if (unsent_.size() > kMostUnsent) {
    throw Fault::unreachable(address_, "it no longer takes requests");
  }
}

void TcpTransport::sendOn() {
  const ssize_t count = ::send(socket_.get(), unsent_.data(), unsent_.size(), MSG_NOSIGNAL);
  if (count >= 0) {
    unsent_.erase(unsent_.begin(), unsent_.begin() + count);
  } else if (errno != EAGAIN && errno != EINTR) {
    throwFault(errno);
  }
}

void TcpTransport::close() noexcept {
  socket_.close();
  datagrams_.close();
  unsent_.clear();
}

void TcpTransport::wakeUp() noexcept {
  wake_up_.raise();
}

void TcpTransport::abort() noexcept {
  aborted_ = true;
  wake_up_.raise();
}

/// Waits for the event or the deadline. It does not return early if wakeUp() is called.
bool TcpTransport::waitFor(int descriptor, short events, TimePoint deadline) {
  while (pollOnce(descriptor, events, deadline).first == 0) {
    if (steady_clock::now() >= deadline) {
      return false;
    }
  }
  return true;
}

/// @param other the wait also ends when this descriptor is readable
/// @return which events each of the two has, errors included; 0 at the deadline or if the wait ended early
std::pair<short, short> TcpTransport::pollOnce(int descriptor, short events, TimePoint deadline, int other) {
  // poll() ignores a descriptor of -1.
  pollfd polled[] = {{wake_up_.descriptor(), POLLIN, 0}, {descriptor, events, 0}, {other, POLLIN, 0}};
  const int count = ::poll(polled, 3, pollTimeout(deadline));
  if (count < 0 && errno != EINTR) {
    std::this_thread::sleep_for(milliseconds(10));  // the kernel is short of memory, so do not try again at once
  }
  if (count > 0 && polled[0].revents != 0) {
    wake_up_.clear();
  }
  if (aborted_) {
    throw StoppedException("the client was stopped");
  }
  return count > 0 ? std::make_pair(polled[1].revents, polled[2].revents) : std::pair<short, short>();
}

void TcpTransport::throwFault(int error) const {
  switch (error) {
    case ECONNREFUSED:
      throw Fault::refused(address_);
    case ECONNRESET:
    case EPIPE:
      throw Fault::closed(address_);
    default:
      throw Fault::unreachable(address_, describe(error));
  }
}

}  // namespace aibo_client
