#include "campaign/interposers.h"

#include <dlfcn.h>
#include <netinet/in.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <mutex>
#include <new>
#include <optional>

namespace fault_bench::interposers {
namespace {

thread_local int own_mark = kUnmarked;
std::atomic<std::int64_t> wall_clock_shift{0};  // s

struct Entry {
  Plan plan;
  unsigned failed = 0;
  clockid_t clock = 0;  // processor time of the thread
  DatagramFault* datagram_fault = nullptr;
  std::deque<DatagramFault::Datagram> datagrams{};  // received and not taken yet
};
std::mutex mutex;
std::array<Entry, kMarks> entries;  // guarded by mutex
std::array<std::atomic<std::size_t>, kMarks> largest_allocations{};

/// The errno to fail with; nothing if the call should work.
std::optional<int> takeFailure(Call call) {
  if (own_mark == kUnmarked) {
    return std::nullopt;
  }
  const std::lock_guard<std::mutex> lock(mutex);
  Entry& entry = entries.at(static_cast<std::size_t>(own_mark));
  Plan& plan = entry.plan;
  if (plan.count == 0 || plan.call != call) {
    return std::nullopt;
  }
  if (plan.skip > 0) {
    --plan.skip;
    return std::nullopt;
  }
  --plan.count;
  ++entry.failed;
  return plan.error;
}

template <typename Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

using RecvFrom = ssize_t(int, void*, size_t, int, sockaddr*, socklen_t*);

/// Receives a datagram with the fault of this thread's mark, from an IPv4 address; nothing if there is no such fault.
std::optional<ssize_t> receiveWithFault(RecvFrom* real, int fd, void* buffer, size_t size, sockaddr* sender,
                                        socklen_t* sender_size) {
  const std::lock_guard<std::mutex> lock(mutex);
  Entry& entry = entries.at(static_cast<std::size_t>(own_mark));
  if (own_mark == kUnmarked || entry.datagram_fault == nullptr) {
    return std::nullopt;
  }
  std::vector<std::uint8_t> bytes(65536);
  ssize_t count = 0;
  while (entry.datagrams.empty() && (count = real(fd, bytes.data(), bytes.size(), 0, sender, sender_size)) >= 0) {
    entry.datagram_fault->arrived({{bytes.begin(), bytes.begin() + count}}, &entry.datagrams);
  }
  if (entry.datagrams.empty()) {
    return -1;
  }
  const DatagramFault::Datagram datagram = entry.datagrams.front();
  entry.datagrams.pop_front();
  auto* address = reinterpret_cast<sockaddr_in*>(sender);
  address->sin_family = AF_INET;
  address->sin_addr.s_addr = htonl(datagram.is_foreign ? INADDR_LOOPBACK + 8 : INADDR_LOOPBACK);
  const size_t taken = std::min(size, datagram.bytes.size());
  std::copy_n(datagram.bytes.begin(), taken, static_cast<std::uint8_t*>(buffer));
  return static_cast<ssize_t>(taken);
}

/// Calls the real function, unless the call should fail.
template <typename Real, typename... Arguments>
auto callOrFail(Call call, Real* real, Arguments... arguments) {
  if (const auto error = takeFailure(call)) {
    errno = *error;
    return decltype(real(arguments...))(-1);
  }
  return real(arguments...);
}

}  // namespace

void markThisThread(int mark) {
  own_mark = mark;
  const std::lock_guard<std::mutex> lock(mutex);
  ::pthread_getcpuclockid(::pthread_self(), &entries.at(static_cast<std::size_t>(mark)).clock);
}

std::chrono::nanoseconds processorTime(int mark) {
  const std::lock_guard<std::mutex> lock(mutex);
  timespec time = {};
  ::clock_gettime(entries.at(static_cast<std::size_t>(mark)).clock, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

void setPlan(int mark, const Plan& plan) {
  const std::lock_guard<std::mutex> lock(mutex);
  Entry& entry = entries.at(static_cast<std::size_t>(mark));
  entry.plan = plan;
  entry.failed = 0;
}

unsigned failed(int mark) {
  const std::lock_guard<std::mutex> lock(mutex);
  return entries.at(static_cast<std::size_t>(mark)).failed;
}

void setDatagramFault(int mark, DatagramFault* fault) {
  const std::lock_guard<std::mutex> lock(mutex);
  Entry& entry = entries.at(static_cast<std::size_t>(mark));
  entry.datagram_fault = fault;
  entry.datagrams.clear();
}

void shiftWallClock(std::chrono::seconds by) {
  wall_clock_shift = by.count();
}

std::size_t takeLargestAllocation(int mark) {
  return largest_allocations.at(static_cast<std::size_t>(mark)).exchange(0);
}

}  // namespace fault_bench::interposers

namespace interposers = fault_bench::interposers;
using interposers::Call;
using interposers::callOrFail;

extern "C" {

int socket(int domain, int type, int protocol) noexcept {
  static const auto real = interposers::next<int(int, int, int)>("socket");
  return callOrFail(Call::kSocket, real, domain, type, protocol);
}

int setsockopt(int fd, int level, int name, const void* value, socklen_t size) noexcept {
  static const auto real = interposers::next<int(int, int, int, const void*, socklen_t)>("setsockopt");
  return callOrFail(Call::kSetsockopt, real, fd, level, name, value, size);
}

int connect(int fd, const sockaddr* address, socklen_t size) {
  static const auto real = interposers::next<int(int, const sockaddr*, socklen_t)>("connect");
  return callOrFail(Call::kConnect, real, fd, address, size);
}

ssize_t recv(int fd, void* buffer, size_t size, int flags) {
  static const auto real = interposers::next<ssize_t(int, void*, size_t, int)>("recv");
  if (const auto error = interposers::takeFailure(Call::kRecv)) {
    errno = *error;
    return *error == 0 ? real(fd, buffer, size < 1 ? size : 1, flags) : -1;
  }
  return real(fd, buffer, size, flags);
}

ssize_t recvfrom(int fd, void* buffer, size_t size, int flags, sockaddr* sender, socklen_t* sender_size) {
  static const auto real = interposers::next<interposers::RecvFrom>("recvfrom");
  const auto count = interposers::receiveWithFault(real, fd, buffer, size, sender, sender_size);
  return count ? *count : real(fd, buffer, size, flags, sender, sender_size);
}

ssize_t send(int fd, const void* buffer, size_t size, int flags) {
  static const auto real = interposers::next<ssize_t(int, const void*, size_t, int)>("send");
  if (const auto error = interposers::takeFailure(Call::kSend)) {
    errno = *error;
    return *error == 0 ? real(fd, buffer, size < 1 ? size : 1, flags) : -1;
  }
  return real(fd, buffer, size, flags);
}

int poll(pollfd* polled, nfds_t count, int timeout) {
  static const auto real = interposers::next<int(pollfd*, nfds_t, int)>("poll");
  return callOrFail(Call::kPoll, real, polled, count, timeout);
}

int ppoll(pollfd* polled, nfds_t count, const timespec* timeout, const sigset_t* signals) {
  static const auto real = interposers::next<int(pollfd*, nfds_t, const timespec*, const sigset_t*)>("ppoll");
  return callOrFail(Call::kPpoll, real, polled, count, timeout, signals);
}

int accept4(int fd, sockaddr* address, socklen_t* size, int flags) {
  static const auto real = interposers::next<int(int, sockaddr*, socklen_t*, int)>("accept4");
  return callOrFail(Call::kAccept, real, fd, address, size, flags);
}

int epoll_create1(int flags) noexcept {
  static const auto real = interposers::next<int(int)>("epoll_create1");
  return callOrFail(Call::kEpollCreate, real, flags);
}

int epoll_ctl(int epoll, int operation, int fd, epoll_event* event) noexcept {
  static const auto real = interposers::next<int(int, int, int, epoll_event*)>("epoll_ctl");
  return callOrFail(Call::kEpollCtl, real, epoll, operation, fd, event);
}

int clock_gettime(clockid_t clock, timespec* time) noexcept {
  static const auto real = interposers::next<int(clockid_t, timespec*)>("clock_gettime");
  const int result = real(clock, time);
  if (clock == CLOCK_REALTIME) {
    time->tv_sec += interposers::wall_clock_shift;
  }
  return result;
}

}  // extern "C"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

// All other forms of new and delete end in these. The threads of one mark run one after the other.
void* operator new(std::size_t size) {
  const int mark = interposers::own_mark;
  if (mark != interposers::kUnmarked && size > interposers::largest_allocations[static_cast<std::size_t>(mark)]) {
    interposers::largest_allocations[static_cast<std::size_t>(mark)] = size;
  }
  if (void* const memory = std::malloc(size == 0 ? 1 : size)) {
    return memory;
  }
  throw std::bad_alloc();
}

void operator delete(void* memory) noexcept {
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

#endif
