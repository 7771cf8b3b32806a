/// @file experiment.h
#ifndef TEST_FAULT_CAMPAIGN_EXPERIMENT_H
#define TEST_FAULT_CAMPAIGN_EXPERIMENT_H

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "aibo_client/rcserver_client.h"
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

  /// Complains also by an exception.
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
  constexpr std::array<Action, 8> kActions = {Action::kClose, Action::kReset,  Action::kHalfClose, Action::kSilence,
                                              Action::kDrop,  Action::kInsert, Action::kFlip,      Action::kPause};
  Fault fault;
  fault.action = kActions[turn % kActions.size()];
  fault.bytes.resize(static_cast<std::size_t>(uniform(random, 1, 50)));
  std::generate(fault.bytes.begin(), fault.bytes.end(),
                [&] { return static_cast<std::uint8_t>(uniform(random, 1, 255)); });
  fault.time = std::chrono::microseconds(uniform(random, 300, 20000));
  return fault;
}

/// A client that wants pictures, joints and sound, and counts what it gets.
class CountingClient {
 public:
  /// @param version newest version of the protocol that it speaks; 0 = the newest there is
  explicit CountingClient(int port, int version = 0) : client_(options(port, version), callbacks()) {
    client_.setStreaming(true);
    client_.setTelemetryPeriod(4);
    client_.setMicrophone({true, 2, 16000});
    client_.start();
  }

  unsigned pictures() const { return pictures_; }

  /// Waits for pictures and joints that come from now on.
  /// @return false if they do not come
  bool getsMore() {
    const unsigned pictures = pictures_;
    const unsigned joints = joints_;
    return eventually([&] { return pictures_ >= pictures + 2 && joints_ >= joints + 2; });
  }

 private:
  static aibo_client::ClientOptions options(int port, int version) {
    aibo_client::ClientOptions options;
    options.port = port;
    options.protocol_version = version;
    return options;
  }

  aibo_client::Callbacks callbacks() {
    aibo_client::Callbacks callbacks;
    callbacks.on_picture = [this](const aibo_client::PicturePtr&) { ++pictures_; };
    callbacks.on_telemetry = [this](const aibo_client::Telemetry& telemetry) {
      joints_ += telemetry.joints.empty() ? 0 : 1;
    };
    return callbacks;
  }

  std::atomic<unsigned> pictures_{0};
  std::atomic<unsigned> joints_{0};
  aibo_client::RcServerClient client_;
};

std::vector<Row> clientRows();
std::vector<Row> hostileRows();
std::vector<Row> serverRows();

}  // namespace fault_bench

#endif  // TEST_FAULT_CAMPAIGN_EXPERIMENT_H
