// F13, F14: faults of the operating system below the client.

#include <cerrno>
#include <climits>
#include <cstring>
#include <thread>

#include "campaign/client_experiment.h"
#include "campaign/interposers.h"

using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace fault_bench {
namespace {

using interposers::Call;

struct Failure {
  Call call;
  int error;  ///< errno; 0 = recv() and send() take only one byte
};

std::string describe(const Failure& failure) {
  return std::string(interposers::kNames[static_cast<std::size_t>(failure.call)]) + "() with " +
         (failure.error == 0 ? "one byte" : std::strerror(failure.error));
}

// All calls that the client makes, and all ways in which they may fail.
const std::vector<Failure> kHarmless = {
    {Call::kRecv, EINTR}, {Call::kRecv, EAGAIN}, {Call::kRecv, 0}, {Call::kPoll, EINTR}, {Call::kPoll, ENOMEM}};
const std::vector<Failure> kHarmful = {{Call::kRecv, ENOMEM},       {Call::kRecv, ECONNRESET}, {Call::kRecv, ETIMEDOUT},
                                       {Call::kRecv, EHOSTUNREACH}, {Call::kSend, EPIPE},      {Call::kSend, ENOBUFS},
                                       {Call::kSend, EAGAIN},       {Call::kSend, EINTR},      {Call::kSend, 0},
                                       {Call::kSend, ENETUNREACH}};
const std::vector<Failure> kOfConnecting = {
    {Call::kSocket, EMFILE},       {Call::kSocket, ENFILE},         {Call::kSocket, ENOBUFS},
    {Call::kSocket, EAFNOSUPPORT}, {Call::kSetsockopt, ENOMEM},     {Call::kConnect, EINTR},
    {Call::kConnect, ENETDOWN},    {Call::kConnect, EADDRNOTAVAIL}, {Call::kConnect, EAGAIN},
    {Call::kConnect, ETIMEDOUT},   {Call::kEpollCreate, EMFILE},    {Call::kEpollCreate, ENOMEM},
    {Call::kEpollCtl, ENOMEM},     {Call::kEpollCtl, ENOSPC}};
const std::size_t kFailures = kHarmless.size() + kHarmful.size() + kOfConnecting.size();

/// F13: a system call of the client fails. Harmless failures do not end the connection; after any other the client
/// connects again.
class SyscallExperiment : public ClientExperiment {
 public:
  using ClientExperiment::ClientExperiment;

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    const SpinCheck spin_check(mark());
    std::size_t which = trial / 2 % kFailures;
    Outcome outcome;
    if (which < kHarmless.size()) {
      outcome = bear(kHarmless[which], random);
    } else if ((which -= kHarmless.size()) < kHarmful.size()) {
      outcome = recover(kHarmful[which], random);
    } else {
      outcome = failToConnect(kOfConnecting[which - kHarmful.size()], random);
    }
    spin_check.conclude(&outcome);
    return outcome;
  }

  void plan(const Failure& failure, unsigned skip, unsigned count) const {
    interposers::setPlan(mark(), {failure.call, failure.error, skip, count});
  }

  static unsigned someCalls(int most, Random& random) { return static_cast<unsigned>(uniform(random, 0, most)); }

  // Few enough for a client that waits a little after each failure, as for ENOMEM, to read in time.
  static constexpr unsigned kInARow = 5;

  Outcome bear(const Failure& failure, Random& random) {
    const std::uint32_t before = connection();
    plan(failure, someCalls(3, random), kInARow);
    for (int i = 0; i < 100 && interposers::failed(mark()) < kInARow; ++i) {
      client_.setStreaming(true);  // wakes the client
      awaitPictures(1);
    }
    return concluded(failure, expectConnection(before));
  }

  Outcome recover(const Failure& failure, Random& random) {
    const std::uint32_t before = connection();
    plan(failure, someCalls(3, random), 1);
    for (int i = 0; i < 10 && interposers::failed(mark()) == 0; ++i) {
      if (failure.call == Call::kSend) {
        proxy_.endConnections(Action::kReset);  // the client sends most at the beginning of a connection
      }
      awaitReconnect(connection(), steady_clock::now());
    }
    Outcome outcome = awaitReconnect(before, steady_clock::now());
    outcome.recovery.reset();
    return concluded(failure, std::move(outcome));
  }

  // Every attempt fails for a while.
  Outcome failToConnect(const Failure& failure, Random& random) {
    constexpr unsigned kOptions = 7;  // set on each socket
    constexpr unsigned kMostAttempts = 20;
    const std::uint32_t before = connection();
    plan(failure, failure.call == Call::kSetsockopt ? someCalls(kOptions - 1, random) : 0, UINT_MAX);
    proxy_.endConnections(Action::kReset);
    const TimePoint begin = steady_clock::now();
    std::this_thread::sleep_for(milliseconds(200));
    while (interposers::failed(mark()) == 0 && steady_clock::now() < begin + kPatience) {
      std::this_thread::sleep_for(milliseconds(10));
    }
    const unsigned attempts = interposers::failed(mark());
    plan(failure, 0, 0);
    Outcome outcome = awaitReconnect(before, steady_clock::now());
    outcome.recovery.reset();
    if (attempts == 0 || attempts > kMostAttempts) {
      outcome.violations.push_back(std::to_string(attempts) + " attempts to connect, after " + describe(failure));
    }
    return outcome;
  }

  Outcome concluded(const Failure& failure, Outcome outcome) const {
    if (interposers::failed(mark()) == 0) {
      outcome.violations.push_back(describe(failure) + " was never called");
    }
    for (std::string& violation : outcome.violations) {
      violation += ", after " + describe(failure);
    }
    plan(failure, 0, 0);
    return outcome;
  }
};

/// F14: the clock of this computer is set. It has no effect.
class ClockExperiment : public ClientExperiment {
 public:
  using ClientExperiment::ClientExperiment;

 private:
  Outcome attempt(unsigned trial, Random&) override {
    const std::uint32_t before = connection();
    interposers::shiftWallClock(std::chrono::hours(trial / 2 % 2 == 0 ? 1 : -1));
    awaitPictures(100);
    interposers::shiftWallClock(std::chrono::seconds(0));
    awaitPictures(100);
    return expectConnection(before);
  }
};

}  // namespace

std::vector<Row> systemRows() {
  const auto sites = static_cast<unsigned>(kFailures);
  return {
      {"F13", "system calls of the client fail", 100 * sites, 8, {}, maker<SyscallExperiment>()},
      {"F14", "wall clock jumps by an hour", 20, 1, {}, maker<InTurn<ClockExperiment>>()},
  };
}

}  // namespace fault_bench
