// F18, F19, F21, F22: faults of every kind on the way to the client, in every state of a connection.

#include <thread>

#include "aibo_client/exceptions.h"
#include "campaign/client_experiment.h"
#include "protocol/version1.h"
#include "protocol/version2.h"
#include "support/version2_frames.h"

using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace version2 = protocol::version2;

namespace fault_bench {
namespace {

/// F18, F19: a fault of any kind at one of the first bytes of a new connection: during the negotiation of the version,
/// in the hello, in replies, in the first picture; or, without a stream, in values and heartbeats.
class BeginningExperiment : public ClientExperiment {
 public:
  BeginningExperiment(unsigned remainder, bool streaming) : ClientExperiment(remainder), streaming_(streaming) {
    client_.setTelemetryPeriod(streaming ? 0 : 4);  // a version 1 server sends nothing unasked
  }

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    Fault fault = anyFault(trial / 2, random);
    fault.place = Place::kByte;
    // No client can notice a changed byte inside a picture.
    const int end = streaming_ && fault.action == Action::kFlip ? greetingSize() : 150;
    fault.offset = static_cast<unsigned>(uniform(random, 0, end - 1));
    client_.setStreaming(streaming_);
    const std::uint64_t connections = client_.statistics().connections;
    witness_.allowGaps(isDamage(fault));
    proxy_.endConnections(Action::kReset);
    const FaultReport report = carryOut(fault);
    client_.setStreaming(true);
    Outcome outcome = awaitPictureAfter(report);
    witness_.allowGaps(false);
    if (fault.action == Action::kSplit && client_.statistics().connections != connections + 1) {
      outcome.violations.push_back(lossOfConnection());
    }
    return outcome;
  }

  /// Bytes in front of the first JPEG.
  int greetingSize() const {
    if (version() == 1) {
      return static_cast<int>(protocol::VALUE_REPLY_SIZE) + headerSize();
    }
    const int hello = static_cast<int>(version2_frames::makeHello().size());
    return static_cast<int>(protocol::VALUE_REPLY_SIZE) + headerSize() + hello;
  }

  const bool streaming_;
};

/// F21: a fault of any kind while takePicture() waits, with or without a stream. The call returns a picture or throws
/// an error with a reason, within its timeout.
class TakePictureExperiment : public ClientExperiment {
 public:
  using ClientExperiment::ClientExperiment;

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    const bool streaming = trial / 16 % 2 == 0;
    Fault fault = anyFault(trial / 2, random);
    fault.place = Place::kPicture;
    // No client can notice a changed byte inside a picture.
    const int end = fault.action == Action::kFlip ? headerSize() : static_cast<int>(kPictureSize);
    fault.offset = static_cast<unsigned>(uniform(random, 0, end - 1));
    setStreaming(streaming);
    witness_.allowGaps(!streaming || isDamage(fault));
    const std::size_t done = proxy_.faultsDone();
    proxy_.add(fault);
    const TimePoint asked = steady_clock::now();
    takePicture();
    const Milliseconds time = steady_clock::now() - asked;
    client_.setStreaming(true);
    const auto report = proxy_.waitForFaults(done + 1, kPatience);
    if (!report) {
      return {{}, {"the fault could not be made, because no picture came"}};
    }
    Outcome outcome = awaitPictureAfter(*report);
    witness_.allowGaps(false);
    if (time > kTime + kLate) {
      outcome.violations.push_back("M: takePicture() took " + std::to_string(time.count()) + " ms");
    }
    return outcome;
  }

  void setStreaming(bool on) {
    client_.setStreaming(on);
    for (const TimePoint end = steady_clock::now() + kPatience; client_.streaming() != on;) {
      if (steady_clock::now() > end) {
        throw std::runtime_error("setStreaming() had no effect");
      }
      std::this_thread::sleep_for(milliseconds(1));
    }
  }

  // The witness sees the pictures that it takes. Any error will do, even a refusal: the fault may turn a header into
  // one.
  void takePicture() {
    try {
      client_.takePicture(0, kTime);
    } catch (const aibo_client::Exception& error) {
      if (std::string(error.what()).empty()) {
        throw std::runtime_error("takePicture() failed without a reason");
      }
    }
  }

  static constexpr milliseconds kTime{1000};
  static constexpr milliseconds kLate{100};
};

/// F22: the way has a long and varying delay, is slow, or stops for a while. Nothing is lost.
class BadWayExperiment : public ClientExperiment {
 public:
  using ClientExperiment::ClientExperiment;

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    const std::uint32_t before = connection();
    Conditions conditions;
    switch (trial / 2 % 4) {
      case 0:
        conditions.delay = milliseconds(uniform(random, 1, 60));
        conditions.jitter = milliseconds(uniform(random, 0, 40));
        break;
      case 1:
        conditions.bytes_per_second = static_cast<std::size_t>(uniform(random, 100000, 1000000));
        break;
      case 2:
        conditions.paused = true;
        break;
      default:
        conditions.delay = milliseconds(uniform(random, 1, 30));
        conditions.bytes_per_second = 500000;
        conditions.largest_piece = static_cast<std::size_t>(uniform(random, 500, 3000));
        conditions.random_pieces = true;
    }
    proxy_.setConditions(conditions);
    if (conditions.paused) {
      std::this_thread::sleep_for(milliseconds(uniform(random, 10, 200)));
    } else {
      awaitPictures(8);
    }
    proxy_.setConditions(Conditions());
    awaitPictures(3);
    return expectConnection(before);
  }
};

}  // namespace

std::vector<Row> wayRows() {
  // The client waits 0.5 s for the answer about version 2, and then another 0.5 s for pictures.
  constexpr Milliseconds kTwoSilences{1500};
  // takePicture() may take its whole second before the fault is noticed.
  constexpr Milliseconds kAfterTheCall{2000};
  return {
      {"F18", "any fault in the first 150 bytes of a connection", 800, 8, kTwoSilences,
       maker<BeginningExperiment>(true)},
      {"F19", "the same without a stream", 400, 16, kTwoSilences, maker<BeginningExperiment>(false)},
      {"F21", "any fault while takePicture() waits", 800, 8, kAfterTheCall, maker<TakePictureExperiment>()},
      {"F22", "long or varying delay, low rate, pauses", 400, 8, {}, maker<BadWayExperiment>()},
  };
}

}  // namespace fault_bench
