/// @file experiment.h
#ifndef TEST_FAULT_CAMPAIGN_EXPERIMENT_H
#define TEST_FAULT_CAMPAIGN_EXPERIMENT_H

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "support/proxy/fault_proxy.h"
#include "support/safety_net.h"

namespace fault_bench {

using namespace test_support;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

using Random = std::mt19937;
using Milliseconds = std::chrono::duration<double, std::milli>;

/// The result of one trial.
struct Outcome {
  std::optional<Milliseconds> recovery;  ///< from the end of the fault to the first good picture; only a figure
  std::vector<std::string> violations;
};

/// Tries faults of one kind, one after the other, on a client or server of its own.
class Experiment {
 public:
  virtual ~Experiment() = default;

  /// @param trial number of the fault; everything random about it follows from this number and the seed
  virtual Outcome run(unsigned trial, Random& random) = 0;
};

/// One row of the table.
struct Row {
  std::string id;
  std::string title;
  unsigned trials;   ///< in the whole campaign
  unsigned at_once;  ///< experiments that run in parallel
  /// Makes the experiment for the trials whose number is `remainder` modulo at_once.
  std::function<std::unique_ptr<Experiment>(unsigned remainder)> make;
};

/// A Row::make for experiments of this class.
template <typename SomeExperiment, typename... Arguments>
std::function<std::unique_ptr<Experiment>(unsigned)> maker(Arguments... arguments) {
  return [=](unsigned remainder) { return std::make_unique<SomeExperiment>(remainder, arguments...); };
}

inline int uniform(Random& random, int lowest, int highest) {
  return std::uniform_int_distribution<int>(lowest, highest)(random);
}

/// Waits until this is true.
/// @throw std::runtime_error with the text: it does not become true
template <typename Condition>
void await(const Condition& condition, const std::string& otherwise) {
  if (!eventually(condition, milliseconds(2))) {
    throw std::runtime_error(otherwise);
  }
}

/// A fault of any kind: the kinds take turns, all other details are random. The caller chooses the place.
inline Fault anyFault(unsigned turn, Random& random) {
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

std::vector<Row> clientRows();
std::vector<Row> hostileRows();
std::vector<Row> serverRows();

}  // namespace fault_bench

#endif  // TEST_FAULT_CAMPAIGN_EXPERIMENT_H
