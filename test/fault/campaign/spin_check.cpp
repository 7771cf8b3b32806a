#include "campaign/spin_check.h"

#include "campaign/syscalls.h"

using std::chrono::steady_clock;

namespace fault_bench {
namespace {

// A short time may be busy.
constexpr Milliseconds kShort{20};

}  // namespace

SpinCheck::SpinCheck(int mark)
    : mark_(mark), begin_(steady_clock::now()), busy_before_(syscalls::processorTime(mark)) {}

void SpinCheck::conclude(Outcome* outcome) const {
  const Milliseconds time = steady_clock::now() - begin_;
  const Milliseconds busy = syscalls::processorTime(mark_) - busy_before_;
  if (busy > kShort + time / 2) {
    outcome->violations.push_back("M: the thread was busy for " + std::to_string(busy.count()) + " of " +
                                  std::to_string(time.count()) + " ms");
  }
}

}  // namespace fault_bench
