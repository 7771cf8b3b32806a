// F1 to F5, F7, F8, F16, I7: faults on the way from the server to the client.

#include <sys/resource.h>

#include <array>
#include <thread>

#include "campaign/client_experiment.h"
#include "protocol/version1.h"
#include "protocol/version2.h"

using aibo_client::ConnectionState;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace fault_bench {
namespace {

/// F1: one segment is split into two, at every offset of a picture in turn, in each version of the protocol.
class SplitExperiment : public ClientExperiment {
 public:
  using ClientExperiment::ClientExperiment;

 private:
  Outcome attempt(unsigned trial, Random&) override {
    Fault split;
    split.action = Action::kSplit;
    split.place = Place::kPicture;
    split.offset = trial / 2 % kPictureSize;
    split.time = microseconds(300);
    const std::uint32_t before = connection();
    carryOut(split);
    awaitPictures(1);
    return expectConnection(before);
  }
};

/// F1b: everything comes byte by byte, in pieces of any size, or many pictures at once.
class SliceExperiment : public ClientExperiment {
 public:
  using ClientExperiment::ClientExperiment;

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    Conditions conditions;
    switch (trial / 4 % 4) {
      case 0:
        conditions.largest_piece = 1;
        break;
      case 1:
        conditions.largest_piece = 7;
        break;
      case 2:
        conditions.largest_piece = static_cast<std::size_t>(uniform(random, 2, 3000));
        conditions.random_pieces = true;
        break;
      default:
        conditions.join = milliseconds(uniform(random, 2, 20));
    }
    const std::uint32_t before = connection();
    proxy_.setConditions(conditions);
    awaitPictures(8);
    proxy_.setConditions(Conditions());
    return expectConnection(before);
  }
};

/// F2, F3: the connection ends in the middle of a picture.
class EndExperiment : public ClientExperiment {
 public:
  EndExperiment(unsigned remainder, Action end) : ClientExperiment(remainder), end_(end) {}

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    const std::uint32_t before = connection();
    Fault fault;
    fault.action = end_;
    fault.place = Place::kPicture;
    fault.offset = trial < 100 ? trial / 4 : static_cast<unsigned>(uniform(random, 0, kPictureSize));
    const FaultReport report = carryOut(fault);
    return awaitReconnect(before, report.time);
  }

  const Action end_;
};

/// F4: bytes that no server sends, inserted before a picture or written over its header.
class GarbageExperiment : public ClientExperiment {
 public:
  using ClientExperiment::ClientExperiment;

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    Fault fault;
    fault.action = trial / 4 % 2 == 0 ? Action::kInsert : Action::kOverwrite;
    fault.place = Place::kPicture;
    fault.bytes = randomBytes(random, uniform(random, 1, 200), 0, 255);
    fault.bytes.front() = static_cast<std::uint8_t>(uniform(random, 'z' + 1, 255));
    return damageAndReconnect(fault);
  }
};

/// F4b: bytes of a header are changed, lost or added, and the result may still be a valid header. The client may notice
/// it later. (F6 is damage behind the header.)
class DamageExperiment : public ClientExperiment {
 public:
  using ClientExperiment::ClientExperiment;

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    const std::array<Action, 4> actions = {Action::kInsert, Action::kOverwrite, Action::kDrop, Action::kFlip};
    Fault fault;
    fault.action = actions[trial / 4 % actions.size()];
    fault.place = Place::kPicture;
    const int offset = uniform(random, 0, headerSize() - 1);
    fault.offset = static_cast<unsigned>(offset);
    fault.count = static_cast<std::size_t>(uniform(random, 1, 2000));
    fault.bytes = randomBytes(random, uniform(random, 1, headerSize() - offset), 1, 255);
    witness_.allowGaps(true);
    Outcome outcome = awaitPictureAfter(carryOut(fault));
    witness_.allowGaps(false);
    return outcome;
  }
};

/// F5: the header announces a wrong size.
class SizeExperiment : public ClientExperiment {
 public:
  using ClientExperiment::ClientExperiment;

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    Fault fault;
    fault.action = Action::kOverwrite;
    fault.place = Place::kPicture;
    fault.offset = version() == 1 ? 1 : 4;
    const std::uint32_t size = announcedSize(trial / 4, random);
    for (int shift = 24; shift >= 0; shift -= 8) {
      fault.bytes.push_back(static_cast<std::uint8_t>(size >> shift & 0xFF));
    }
    return damageAndReconnect(fault);
  }

  static std::uint32_t announcedSize(unsigned kind, Random& random) {
    constexpr auto kMost = static_cast<std::uint32_t>(protocol::version2::MAX_PAYLOAD_TOWARDS_CLIENT);
    const std::array<std::uint32_t, 8> sizes = {0, 1, 3, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, kMost + 1, kMost};
    const auto which = kind % (sizes.size() + 2);
    if (which < sizes.size()) {
      return sizes[which];
    }
    return static_cast<std::uint32_t>(which == sizes.size() ? uniform(random, 4, 3000) : uniform(random, 6000, 20000));
  }
};

/// F7: the server or the network falls silent for a while.
class SilenceExperiment : public ClientExperiment {
 public:
  enum class Kind { kServerStopped, kBlackHole, kUnreachable };

  SilenceExperiment(unsigned remainder, Kind kind) : ClientExperiment(remainder), kind_(kind) {}

 private:
  static constexpr Milliseconds kDetectionMark{600};

  Outcome attempt(unsigned, Random& random) override {
    const std::uint32_t before = connection();
    fallSilent();
    const auto lost = witness_.waitForState(ConnectionState::kDisconnected, kPatience);
    if (!lost) {
      return {{}, {"the client did not notice the silence"}};
    }
    const Milliseconds detection = *lost - witness_.last().arrival;
    std::this_thread::sleep_for(milliseconds(uniform(random, 0, 200)));
    comeBack();
    Outcome outcome = awaitReconnect(before, steady_clock::now());
    if (detection > kDetectionMark) {
      outcome.violations.push_back("M: the silence was noticed after " + std::to_string(detection.count()) + " ms");
    }
    return outcome;
  }

  void fallSilent() {
    if (kind_ == Kind::kServerStopped) {
      server_.setStopped(true);
      return;
    }
    proxy_.setWelcome(kind_ == Kind::kBlackHole ? Welcome::kSilence : Welcome::kUnreachable);
    proxy_.endConnections(Action::kSilence);
  }

  void comeBack() {
    server_.setStopped(false);
    proxy_.heal();
  }

  const Kind kind_;
};

/// F8: the server is away for a while, or has moved.
class AbsenceExperiment : public ClientExperiment {
 public:
  enum class Kind { kRestart, kPortClosed, kNameUnknown, kTurnedAway, kMoved };

  AbsenceExperiment(unsigned remainder, Kind kind) : ClientExperiment(remainder), kind_(kind) {}

 private:
  Outcome attempt(unsigned, Random& random) override {
    const std::uint32_t before = connection();
    if (kind_ == Kind::kMoved) {
      const int next = address_ % 3 + 1;
      const TimePoint moved = steady_clock::now();
      proxy_.moveTo("127.0.0." + std::to_string(next));
      address_ = next;
      Outcome outcome = awaitReconnect(before, moved);
      proxy_.heal();
      return outcome;
    }
    goAway();
    std::this_thread::sleep_for(absence(random));
    name_known_ = true;
    proxy_.heal();
    return awaitReconnect(before, steady_clock::now());
  }

  void goAway() {
    name_known_ = kind_ != Kind::kNameUnknown;
    if (kind_ == Kind::kTurnedAway) {
      proxy_.setWelcome(Welcome::kClose);
    } else if (kind_ != Kind::kNameUnknown) {
      proxy_.setWelcome(Welcome::kRefuse);
    }
    proxy_.endConnections(Action::kReset);
  }

  milliseconds absence(Random& random) const {
    return milliseconds(kind_ == Kind::kRestart ? uniform(random, 20, 300) : uniform(random, 0, 4000));
  }

  const Kind kind_;
};

/// F16: no fault, at many times a camera's rate. Nothing is lost, and memory does not grow.
class FastStreamExperiment : public ClientExperiment {
 public:
  explicit FastStreamExperiment(unsigned remainder) : ClientExperiment(remainder, milliseconds(1)) {}

 private:
  Outcome attempt(unsigned, Random&) override {
    const std::uint32_t before = connection();
    awaitPictures(1000);
    return expectConnection(before);
  }
};

/// I7: waiting for a robot takes hardly any processor time.
class IdleExperiment : public ClientExperiment {
 public:
  using ClientExperiment::ClientExperiment;

 private:
  Outcome attempt(unsigned trial, Random&) override {
    constexpr std::array<Welcome, 3> kWelcomes = {Welcome::kRefuse, Welcome::kUnreachable, Welcome::kSilence};
    proxy_.setWelcome(kWelcomes[trial / 2 % kWelcomes.size()]);
    proxy_.endConnections(Action::kReset);
    witness_.waitForState(ConnectionState::kDisconnected, kPatience);
    server_.setStopped(true);
    const Milliseconds before = processorTime();
    std::this_thread::sleep_for(kTime);
    const Milliseconds used = processorTime() - before;
    server_.setStopped(false);
    proxy_.heal();
    Outcome outcome;
    if (used > 0.01 * Milliseconds(kTime)) {
      outcome.violations.push_back("M: I7: " + std::to_string(used.count()) + " ms of processor time in " +
                                   std::to_string(kTime.count()) + " ms without a connection");
    }
    return outcome;
  }

  static Milliseconds processorTime() {
    timespec time = {};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
  }

  static constexpr milliseconds kTime{3000};
};

}  // namespace

std::vector<Row> clientRows() {
  using Silence = SilenceExperiment::Kind;
  using Absence = AbsenceExperiment::Kind;
  constexpr Milliseconds kSoon{250};
  constexpr Milliseconds kHalfASecond{500};
  // The client waits up to 2 s between two attempts. Then it still has to connect and to receive a picture.
  constexpr Milliseconds kLongestWait{2100};
  return {
      {"F1", "split at every offset, twice in each version", 4 * kPictureSize, 4, {}, maker<SplitExperiment>()},
      {"F1b", "pieces of 1, 7 and random sizes, pictures joined", 400, 2, {}, maker<SliceExperiment>()},
      {"F2", "closed in the middle of a picture", 3000, 8, kSoon, maker<EndExperiment>(Action::kClose)},
      {"F3", "reset in the middle of a picture", 3000, 8, kSoon, maker<EndExperiment>(Action::kReset)},
      {"F4", "garbage before or over a header", 1000, 8, kSoon, maker<GarbageExperiment>()},
      {"F4b", "bytes lost, inserted, flipped in or by a header", 1000, 8, kSoon, maker<DamageExperiment>()},
      {"F5", "impossible, too short and too long sizes", 1000, 8, kSoon, maker<SizeExperiment>()},
      {"F7", "server stopped", 100, 16, kHalfASecond, maker<SilenceExperiment>(Silence::kServerStopped)},
      {"F7b", "black hole that still accepts", 100, 16, kHalfASecond, maker<SilenceExperiment>(Silence::kBlackHole)},
      {"F7c", "nothing gets through, no answer to connect", 100, 16, kHalfASecond,
       maker<SilenceExperiment>(Silence::kUnreachable)},
      {"F8", "server gone for up to 0.3 s", 200, 16, kHalfASecond, maker<AbsenceExperiment>(Absence::kRestart)},
      {"F8b", "port closed for up to 4 s", 100, 16, kLongestWait, maker<AbsenceExperiment>(Absence::kPortClosed)},
      {"F8c", "name unknown for up to 4 s", 100, 16, kLongestWait, maker<AbsenceExperiment>(Absence::kNameUnknown)},
      {"F8d", "turned away for up to 4 s", 100, 16, kLongestWait, maker<AbsenceExperiment>(Absence::kTurnedAway)},
      {"F8e", "robot has moved to another address", 100, 8, Milliseconds(1100),
       maker<AbsenceExperiment>(Absence::kMoved)},
      {"F16", "1,000 pictures in a second, no fault", 1200, 2, {}, maker<FastStreamExperiment>()},
      {"I7", "processor time while no server is there", 12, 1, {}, maker<InTurn<IdleExperiment>>()},
  };
}

}  // namespace fault_bench
