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
#include "support/safety_net.h"

namespace fault_bench {

using namespace test_support;

using Random = std::mt19937;
using Milliseconds = std::chrono::duration<double, std::milli>;

/// How long a trial waits for what has to happen.
constexpr std::chrono::seconds kPatience = kSafetyNet;

/// The result of one trial.
struct Outcome {
  std::optional<Milliseconds> recovery;  ///< from the end of the fault to the first good picture
  std::vector<std::string> violations;   ///< those that begin with "M" are about time: a busy computer can cause them
  bool excused = false;                  ///< pictures are missing, but the client itself left them out as stale
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
  unsigned trials = 0;            ///< in the whole campaign
  unsigned at_once = 1;           ///< experiments that run in parallel
  Milliseconds recovery_mark{0};  ///< 99 of 100 trials must recover within this time; 0 = no limit
  /// Makes the experiment for the trials whose number is `remainder` modulo at_once.
  std::function<std::unique_ptr<Experiment>(unsigned remainder)> make;
};

/// A Row::make for experiments of this class.
template <typename SomeExperiment, typename... Arguments>
std::function<std::unique_ptr<Experiment>(unsigned)> maker(Arguments... arguments) {
  return [=](unsigned remainder) { return std::make_unique<SomeExperiment>(remainder, arguments...); };
}

int uniform(Random& random, int lowest, int highest);

/// @param count how many bytes
/// @param lowest, highest range of each byte
Bytes randomBytes(Random& random, int count, int lowest, int highest);

/// A fault of any kind: the kinds take turns, all other details are random. The caller chooses the place.
Fault anyFault(unsigned turn, Random& random);

/// True if the fault changes bytes, but need not end the connection.
bool isDamage(const Fault& fault);

/// Options of a proxy in front of the server on this port of 127.0.0.1.
FaultProxy::Options proxyTo(int port, unsigned seed);

/// Finds out whether a thread, from the construction on, waits or is busy retrying.
class SpinCheck {
 public:
  /// @param mark of the thread (interposers.h)
  explicit SpinCheck(int mark);

  /// Adds a violation if the thread was busy most of the time.
  void conclude(Outcome* outcome) const;

 private:
  const int mark_;
  const TimePoint begin_;
  const Milliseconds busy_before_;
};

/// All rows of the table.
std::vector<Row> allRows();

std::vector<Row> clientRows();
std::vector<Row> datagramRows();
std::vector<Row> hostileRows();
std::vector<Row> pictureRows();
std::vector<Row> systemRows();
std::vector<Row> serverRows();
std::vector<Row> stickRows();
std::vector<Row> wayRows();

}  // namespace fault_bench

#endif  // TEST_FAULT_CAMPAIGN_EXPERIMENT_H
