// F13, F14: the operating system below the client has its days.

#include <cerrno>
#include <cstring>

#include "campaign/client_experiment.h"
#include "support/syscalls.h"

using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace fault_bench {
namespace {

using syscalls::Call;

struct Failure {
  Call call;
  int error;  ///< 0: recv() and send() take one byte only
};

std::string describe(const Failure& failure) {
  return std::string(syscalls::kNames[static_cast<std::size_t>(failure.call)]) + "() with " +
         (failure.error == 0 ? "one byte" : std::strerror(failure.error));
}

// Each call the client makes, and each way in which it may fail.
const std::vector<Failure> kHarmless = {
    {Call::kRecv, EINTR}, {Call::kRecv, EAGAIN}, {Call::kRecv, 0}, {Call::kPoll, EINTR}, {Call::kPoll, ENOMEM}};
const std::vector<Failure> kHarmful = {{Call::kRecv, ENOMEM},
                                       {Call::kRecv, ECONNRESET},
                                       {Call::kRecv, ETIMEDOUT},
                                       {Call::kRecv, EHOSTUNREACH},
                                       {Call::kSocket, EMFILE},
                                       {Call::kSocket, ENFILE},
                                       {Call::kSocket, ENOBUFS},
                                       {Call::kSocket, EAFNOSUPPORT},
                                       {Call::kSetsockopt, ENOMEM},
                                       {Call::kConnect, EINTR},
                                       {Call::kConnect, ENETDOWN},
                                       {Call::kConnect, EADDRNOTAVAIL},
                                       {Call::kConnect, EAGAIN},
                                       {Call::kConnect, ETIMEDOUT},
                                       {Call::kSend, EPIPE},
                                       {Call::kSend, ENOBUFS},
                                       {Call::kSend, EAGAIN},
                                       {Call::kSend, EINTR},
                                       {Call::kSend, 0},
                                       {Call::kSend, ENETUNREACH}};

/// F13: a system call of the client fails. What is no fault is none; anything else ends in a new connection.
class SyscallExperiment : public ClientExperiment {
 public:
  using ClientExperiment::ClientExperiment;

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    const unsigned which = trial % static_cast<unsigned>(kHarmless.size() + kHarmful.size());
    return which < kHarmless.size() ? bear(kHarmless[which], random)
                                    : recover(kHarmful[which - kHarmless.size()], random);
  }

  void plan(const Failure& failure, unsigned count, Random& random) const {
    syscalls::setPlan(mark(), {failure.call, failure.error, static_cast<unsigned>(uniform(random, 0, 3)), count});
  }

  Outcome bear(const Failure& failure, Random& random) {
    const std::uint32_t before = connection();
    constexpr unsigned kInARow = 20;
    plan(failure, kInARow, random);
    for (int i = 0; i < 100 && syscalls::failed(mark()) < kInARow; ++i) {
      client_.setStreaming(true);  // wakes the client
      awaitPictures(1);
    }
    Outcome outcome = expectConnection(before);
    return concluded(failure, std::move(outcome));
  }

  Outcome recover(const Failure& failure, Random& random) {
    const std::uint32_t before = connection();
    plan(failure, 1, random);
    for (int i = 0; i < 10 && syscalls::failed(mark()) == 0; ++i) {
      // Connecting is what most of these are made for.
      if (failure.call != Call::kRecv) {
        proxy_.endConnections(Action::kReset);
      }
      awaitReconnect(connection(), steady_clock::now());
    }
    Outcome outcome = awaitReconnect(before, steady_clock::now());
    outcome.recovery.reset();
    return concluded(failure, std::move(outcome));
  }

  Outcome concluded(const Failure& failure, Outcome outcome) const {
    if (syscalls::failed(mark()) == 0) {
      outcome.violations.push_back(describe(failure) + " was never called");
    }
    for (std::string& violation : outcome.violations) {
      violation += ", after " + describe(failure);
    }
    syscalls::setPlan(mark(), {});
    return outcome;
  }
};

/// F14: somebody sets this computer's clock. Nobody notices.
class ClockExperiment : public ClientExperiment {
 public:
  using ClientExperiment::ClientExperiment;

 private:
  Outcome attempt(unsigned trial, Random&) override {
    const std::uint32_t before = connection();
    syscalls::shiftWallClock(std::chrono::hours(trial / 2 % 2 == 0 ? 1 : -1));
    awaitPictures(100);
    syscalls::shiftWallClock(std::chrono::seconds(0));
    awaitPictures(100);
    return expectConnection(before);
  }
};

}  // namespace

std::vector<Row> systemRows() {
  const auto sites = static_cast<unsigned>(kHarmless.size() + kHarmful.size());
  return {
      {"F13", "system calls of the client fail", 100 * sites, 8, {}, maker<SyscallExperiment>()},
      {"F14", "wall clock jumps by an hour", 20, 1, {}, maker<InTurn<ClockExperiment>>()},
  };
}

}  // namespace fault_bench
