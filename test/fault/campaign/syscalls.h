/// @file syscalls.h
/// Takes the place of system calls in the program that it is linked into, and in its libraries, so that they fail when
/// they are told to: without privileges, and at every place that calls them.
#ifndef TEST_FAULT_CAMPAIGN_SYSCALLS_H
#define TEST_FAULT_CAMPAIGN_SYSCALLS_H

#include <array>
#include <chrono>

namespace fault_bench::syscalls {

enum class Call { kSocket, kSetsockopt, kConnect, kRecv, kSend, kPoll, kPpoll, kAccept, kEpollCreate, kEpollCtl };
constexpr std::array<const char*, 10> kNames = {"socket", "setsockopt", "connect", "recv",          "send",
                                                "poll",   "ppoll",      "accept4", "epoll_create1", "epoll_ctl"};

/// Whose call it is: only threads with a mark fail, and each mark has a plan of its own.
constexpr int kUnmarked = 0;
constexpr int kMarks = 64;
/// @param mark 1..kMarks - 1, or kUnmarked
void markThisThread(int mark);
int markOfThisThread();

/// Processor time that the thread which got this mark last has used.
std::chrono::nanoseconds processorTime(int mark);

/// What is to fail.
struct Plan {
  Call call = Call::kRecv;
  int error = 0;       ///< errno; 0 = recv() and send() take one byte only
  unsigned skip = 0;   ///< so many calls work before
  unsigned count = 0;  ///< so many fail
};
void setPlan(int mark, const Plan& plan);

/// How many calls have failed since setPlan().
unsigned failed(int mark);

/// The wall clock of this process is wrong by so much.
void shiftWallClock(std::chrono::seconds by);

}  // namespace fault_bench::syscalls

#endif  // TEST_FAULT_CAMPAIGN_SYSCALLS_H
