#include "campaign/any_fault.h"

#include <algorithm>
#include <array>

namespace fault_bench {

Fault anyFault(unsigned turn, Random& random) {
  constexpr std::array<Action, 8> kActions = {Action::kClose, Action::kReset,  Action::kHalfClose, Action::kSilence,
                                              Action::kDrop,  Action::kInsert, Action::kFlip,      Action::kSplit};
  Fault fault;
  fault.action = kActions[turn % kActions.size()];
  fault.count = static_cast<std::size_t>(uniform(random, 1, 50));
  fault.bytes.resize(fault.action == Action::kFlip ? 1 : fault.count);
  std::generate(fault.bytes.begin(), fault.bytes.end(),
                [&random] { return static_cast<std::uint8_t>(uniform(random, 1, 255)); });
  fault.time = std::chrono::microseconds(uniform(random, 300, 20000));
  return fault;
}

bool isDamage(const Fault& fault) {
  return fault.action == Action::kDrop || fault.action == Action::kInsert || fault.action == Action::kFlip;
}

}  // namespace fault_bench
