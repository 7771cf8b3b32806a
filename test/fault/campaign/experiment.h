/// @file experiment.h
#ifndef TEST_FAULT_CAMPAIGN_EXPERIMENT_H
#define TEST_FAULT_CAMPAIGN_EXPERIMENT_H

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "support/proxy/fault_proxy.h"

namespace fault_bench {

using namespace test_support;

using Random = std::mt19937;
using Milliseconds = std::chrono::duration<double, std::milli>;

/// What became of one fault.
struct Outcome {
  std::optional<Milliseconds> recovery;  ///< from when nothing was wrong any more to the first good picture
  std::vector<std::string> violations;   ///< those that begin with M are of time: a busy computer is to blame, too
  bool excused = false;                  ///< pictures are missing, which the client itself has left out as stale
};

/// Tries faults of one kind, one after the other, on a client or server of its own.
class Experiment {
 public:
  virtual ~Experiment() = default;

  /// @param trial number of the fault; all that is random about it follows from it and the seed
  virtual Outcome run(unsigned trial, Random& random) = 0;
};

/// One line of the table.
struct Row {
  std::string id;
  std::string title;
  unsigned trials = 0;            ///< in the whole campaign
  unsigned at_once = 1;           ///< experiments that run beside each other
  Milliseconds recovery_mark{0};  ///< 99 of 100 recover within this time; 0 = no mark
  /// Makes the experiment for the trials whose number is `remainder` modulo at_once.
  std::function<std::unique_ptr<Experiment>(unsigned remainder)> make;
};

/// What Row::make needs to make such an experiment.
template <typename SomeExperiment, typename... Arguments>
std::function<std::unique_ptr<Experiment>(unsigned)> maker(Arguments... arguments) {
  return [=](unsigned remainder) { return std::make_unique<SomeExperiment>(remainder, arguments...); };
}

int uniform(Random& random, int lowest, int highest);

/// Of a proxy before the server on this port of 127.0.0.1.
FaultProxy::Options proxyTo(int port, unsigned seed);

/// All lines of the table.
std::vector<Row> allRows();

std::vector<Row> clientRows();
std::vector<Row> pictureRows();
std::vector<Row> systemRows();
std::vector<Row> serverRows();
std::vector<Row> wayRows();

}  // namespace fault_bench

#endif  // TEST_FAULT_CAMPAIGN_EXPERIMENT_H
