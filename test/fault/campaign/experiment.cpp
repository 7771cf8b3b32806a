#include "campaign/experiment.h"

#include <algorithm>
#include <array>

namespace fault_bench {

Fault anyFault(unsigned turn, Random& random) {
  constexpr std::array<Action, 10> kActions = {Action::kClose, Action::kReset,  Action::kHalfClose, Action::kSilence,
                                               Action::kDrop,  Action::kInsert, Action::kOverwrite, Action::kFlip,
                                               Action::kPause, Action::kSplit};
  Fault fault;
  fault.action = kActions[turn % kActions.size()];
  fault.count = static_cast<std::size_t>(uniform(random, 1, 50));
  // No client can notice a changed byte inside a picture, so it has to be one that the caller chooses.
  const bool changes = fault.action == Action::kFlip || fault.action == Action::kOverwrite;
  fault.bytes.resize(changes ? 1 : fault.count);
  std::generate(fault.bytes.begin(), fault.bytes.end(),
                [&] { return static_cast<std::uint8_t>(uniform(random, 1, 255)); });
  fault.time = std::chrono::microseconds(uniform(random, 300, 20000));
  return fault;
}

}  // namespace fault_bench
