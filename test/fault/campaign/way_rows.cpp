// F18, F19, F21, F22: anything that can go wrong on the way, wherever a connection is at that time.

#include <thread>

#include "aibo_driver/exceptions.h"
#include "campaign/any_fault.h"
#include "campaign/client_experiment.h"
#include "protocol/version1.h"
#include "protocol/version2.h"
#include "support/version2_frames.h"

using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace version2 = protocol::version2;

namespace fault_bench {
namespace {

/// Anything goes wrong once; pictures come again.
class AnyFaultExperiment : public ClientExperiment {
 public:
  using ClientExperiment::ClientExperiment;

 protected:
  /// Of the header before a picture.
  int headerSize() const {
    return static_cast<int>(version() == 1 ? protocol::PICTURE_HEADER_SIZE : version2::FRAME_HEADER_SIZE);
  }

  /// Waits for a picture that was sent after the fault.
  Outcome awaitPictureAfter(const FaultReport& report) {
    const auto back =
        witness_.waitFor([&](const Witness::Sighting& each) { return each.sent > report.time; }, kPatience);
    if (!back) {
      return {{}, {"no picture came any more: " + client_.status().reason}};
    }
    proxy_.heal();  // a connection that fell silent would stand for ever
    return {back->time - report.time, {}};
  }
};

/// F18, F19: at any of the first bytes of a new connection: while the version of the protocol is found out, in the
/// hello, in replies, in the first picture; or while no pictures are wanted, in values and heartbeats.
class BeginningExperiment : public AnyFaultExperiment {
 public:
  BeginningExperiment(unsigned remainder, bool streaming) : AnyFaultExperiment(remainder), streaming_(streaming) {
    client_.setTelemetryPeriod(streaming ? 0 : 4);  // a version 1 server says nothing if it is not asked
  }

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    Fault fault = anyFault(trial / 2, random);
    fault.place = Place::kByte;
    // No client can tell that a byte amid a picture is another one.
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

  /// All that comes before the first picture's JPEG.
  int greetingSize() const {
    if (version() == 1) {
      return static_cast<int>(protocol::VALUE_REPLY_SIZE) + headerSize();
    }
    const int hello = static_cast<int>(version2_frames::makeHello().size());
    return static_cast<int>(protocol::VALUE_REPLY_SIZE) + headerSize() + hello;
  }

  const bool streaming_;
};

/// F21: while somebody waits for a picture, from a stream or for this call alone. He gets an answer or is told why not,
/// within his time.
class TakePictureExperiment : public AnyFaultExperiment {
 public:
  using AnyFaultExperiment::AnyFaultExperiment;

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    const bool streaming = trial / 16 % 2 == 0;
    Fault fault = anyFault(trial / 2, random);
    fault.place = Place::kPicture;
    // No client can tell that a byte amid a picture is another one.
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
      return {{}, {"the fault could not be made"}};
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
        throw std::runtime_error("setStreaming() has no effect");
      }
      std::this_thread::sleep_for(milliseconds(1));
    }
  }

  // The witness sees what it takes. Any answer will do, also that the robot has refused: a header may be made one.
  void takePicture() {
    try {
      client_.takePicture(0, kTime);
    } catch (const aibo_driver::Exception& error) {
      if (std::string(error.what()).empty()) {
        throw std::runtime_error("takePicture() failed, and does not say why");
      }
    }
  }

  static constexpr milliseconds kTime{1000};
  static constexpr milliseconds kLate{100};
};

/// F22: a way that is long, and never as long as before, or slow, or stopped for a while. Nothing is lost.
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
  // A server that does not answer is asked for 0.5 s whether it speaks version 2, and then for pictures as long.
  constexpr Milliseconds kTwoSilences{1500};
  // He who asks may wait for all of his second until the fault is noticed.
  constexpr Milliseconds kAfterTheCall{2000};
  return {
      {"F18", "anything at the first 150 bytes of a connection", 800, 8, kTwoSilences,
       maker<BeginningExperiment>(true)},
      {"F19", "the same while no pictures are wanted", 400, 16, kTwoSilences, maker<BeginningExperiment>(false)},
      {"F21", "anything while takePicture() waits", 800, 8, kAfterTheCall, maker<TakePictureExperiment>()},
      {"F22", "a long, uneven, slow way, or one that stops", 400, 8, {}, maker<BadWayExperiment>()},
  };
}

}  // namespace fault_bench
