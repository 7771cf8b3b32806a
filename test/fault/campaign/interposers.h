/// @file interposers.h
/// Functions that replace system calls and operator new in the program that they are linked into, and in its libraries.
/// So system calls can be made to fail without privileges and wherever they are made, and large allocations are seen.
#ifndef TEST_FAULT_CAMPAIGN_INTERPOSERS_H
#define TEST_FAULT_CAMPAIGN_INTERPOSERS_H

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace fault_bench::interposers {

enum class Call { kSocket, kSetsockopt, kConnect, kRecv, kSend, kPoll, kPpoll, kAccept, kEpollCreate, kEpollCtl };
constexpr std::array<const char*, 10> kNames = {"socket", "setsockopt", "connect", "recv",          "send",
                                                "poll",   "ppoll",      "accept4", "epoll_create1", "epoll_ctl"};

/// Calls fail only in threads with a mark. Each mark has a plan of its own.
constexpr int kUnmarked = 0;
constexpr int kMarks = 64;
/// @param mark 1..kMarks - 1, or kUnmarked
void markThisThread(int mark);

/// Processor time used by the thread that was last given this mark.
std::chrono::nanoseconds processorTime(int mark);

/// Which calls fail.
struct Plan {
  Call call = Call::kRecv;
  int error = 0;       ///< errno; 0 = recv() and send() succeed, but take only one byte
  unsigned skip = 0;   ///< number of calls that work before the first failure
  unsigned count = 0;  ///< number of calls that fail
};
void setPlan(int mark, const Plan& plan);

/// Number of calls that have failed since setPlan().
unsigned failed(int mark);

/// What becomes of datagrams that threads with this mark receive.
class DatagramFault {
 public:
  struct Datagram {
    std::vector<std::uint8_t> bytes;
    bool is_foreign = false;  ///< it comes from another address
  };

  virtual ~DatagramFault() = default;

  /// A datagram has come. It, or others, are added to `received`, from which the thread takes them in turn.
  virtual void arrived(Datagram datagram, std::deque<Datagram>* received) = 0;
};

/// @param fault nullptr = none; must outlive its use
void setDatagramFault(int mark, DatagramFault* fault);

/// Makes the wall clock of this process wrong by this much.
void shiftWallClock(std::chrono::seconds by);

/// The most bytes that threads with this mark have allocated at once, since the last call. Under a sanitizer, which has
/// its own operator new, 0.
std::size_t takeLargestAllocation(int mark);

}  // namespace fault_bench::interposers

#endif  // TEST_FAULT_CAMPAIGN_INTERPOSERS_H
