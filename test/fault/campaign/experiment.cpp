#include "campaign/experiment.h"

#include <algorithm>
#include <array>

#include "campaign/interposers.h"

using std::chrono::steady_clock;

namespace fault_bench {
namespace {

// A thread may be busy for a short time.
constexpr Milliseconds kShort{20};

}  // namespace

int uniform(Random& random, int lowest, int highest) {
  return std::uniform_int_distribution<int>(lowest, highest)(random);
}

Bytes randomBytes(Random& random, int count, int lowest, int highest) {
  Bytes bytes(static_cast<std::size_t>(count));
  std::generate(bytes.begin(), bytes.end(),
                [&] { return static_cast<std::uint8_t>(uniform(random, lowest, highest)); });
  return bytes;
}

Fault anyFault(unsigned turn, Random& random) {
  constexpr std::array<Action, 8> kActions = {Action::kClose, Action::kReset,  Action::kHalfClose, Action::kSilence,
                                              Action::kDrop,  Action::kInsert, Action::kFlip,      Action::kSplit};
  Fault fault;
  fault.action = kActions[turn % kActions.size()];
  const int count = uniform(random, 1, 50);
  fault.count = static_cast<std::size_t>(count);
  fault.bytes = randomBytes(random, fault.action == Action::kFlip ? 1 : count, 1, 255);
  fault.time = std::chrono::microseconds(uniform(random, 300, 20000));
  return fault;
}

bool isDamage(const Fault& fault) {
  return fault.action == Action::kDrop || fault.action == Action::kInsert || fault.action == Action::kFlip;
}

FaultProxy::Options proxyTo(int port, unsigned seed) {
  FaultProxy::Options options;
  options.target_port = port;
  options.seed = seed;
  return options;
}

SpinCheck::SpinCheck(int mark)
    : mark_(mark), begin_(steady_clock::now()), busy_before_(interposers::processorTime(mark)) {}

void SpinCheck::conclude(Outcome* outcome) const {
  const Milliseconds time = steady_clock::now() - begin_;
  const Milliseconds busy = interposers::processorTime(mark_) - busy_before_;
  if (busy > kShort + time / 2) {
    outcome->violations.push_back("M: the thread was busy for " + std::to_string(busy.count()) + " of " +
                                  std::to_string(time.count()) + " ms");
  }
}

}  // namespace fault_bench
