// F1 to F5, F7, F8: what can go wrong on the way from the server to the client.

#include <sys/resource.h>

#include <array>
#include <thread>

#include "campaign/client_experiment.h"
#include "protocol/version1.h"
#include "protocol/version2.h"

using aibo_driver::ConnectionState;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace fault_bench {
namespace {

/// F1: one segment becomes two, at every offset of a picture in turn. Each version of the protocol has all of them.
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

/// F1: everything comes in drops, in pieces of any size, or many pictures at once.
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

/// F2, F3: the connection ends after so many bytes of a picture.
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

/// F4: bytes that no server sends, before a picture, in the place of its first byte, or amid it.
class GarbageExperiment : public ClientExperiment {
 public:
  using ClientExperiment::ClientExperiment;

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    const std::uint32_t before = connection();
    Fault fault;
    fault.action = trial / 4 % 2 == 0 ? Action::kInsert : Action::kOverwrite;
    fault.place = Place::kPicture;
    fault.bytes.resize(static_cast<std::size_t>(uniform(random, 1, 200)));
    for (std::uint8_t& byte : fault.bytes) {
      byte = static_cast<std::uint8_t>(uniform(random, 0, 255));
    }
    fault.bytes.front() = static_cast<std::uint8_t>(uniform(random, 'z' + 1, 255));
    witness_.allowGaps(true);
    const FaultReport report = carryOut(fault);
    Outcome outcome = awaitReconnect(before, report.time);
    witness_.allowGaps(false);
    return outcome;
  }
};

/// F4: a header is damaged, but may still be one, or bytes are lost or too many. The client may notice that later.
/// (Damage behind the header is F6.)
class DamageExperiment : public ClientExperiment {
 public:
  using ClientExperiment::ClientExperiment;

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    const std::array<Action, 4> actions = {Action::kInsert, Action::kOverwrite, Action::kDrop, Action::kFlip};
    Fault fault;
    fault.action = actions[trial / 4 % actions.size()];
    fault.place = Place::kPicture;
    const int header_size = version() == 1 ? 5 : 8;
    const int offset = uniform(random, 0, header_size - 1);
    fault.offset = static_cast<unsigned>(offset);
    fault.count = static_cast<std::size_t>(uniform(random, 1, 2000));
    fault.bytes.resize(static_cast<std::size_t>(uniform(random, 1, header_size - offset)));
    for (std::uint8_t& byte : fault.bytes) {
      byte = static_cast<std::uint8_t>(uniform(random, 1, 255));
    }
    witness_.allowGaps(true);
    const FaultReport report = carryOut(fault);
    const auto back =
        witness_.waitFor([&](const Witness::Sighting& each) { return each.sent > report.time; }, kPatience);
    witness_.allowGaps(false);
    if (!back) {
      return {{}, {"no picture came any more: " + client_.status().reason}};
    }
    return {back->time - report.time, {}};
  }
};

/// F5: the header announces another size than the picture has.
class SizeExperiment : public ClientExperiment {
 public:
  using ClientExperiment::ClientExperiment;

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    const std::uint32_t before = connection();
    Fault fault;
    fault.action = Action::kOverwrite;
    fault.place = Place::kPicture;
    fault.offset = version() == 1 ? 1 : 4;
    const std::uint32_t size = announcedSize(trial / 4, random);
    for (int shift = 24; shift >= 0; shift -= 8) {
      fault.bytes.push_back(static_cast<std::uint8_t>(size >> shift & 0xFF));
    }
    witness_.allowGaps(true);
    const FaultReport report = carryOut(fault);
    Outcome outcome = awaitReconnect(before, report.time);
    witness_.allowGaps(false);
    return outcome;
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

/// F7: the server or the network falls silent, and comes back.
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
      return {{}, {"the silence was not noticed"}};
    }
    const Milliseconds detection = *lost - witness_.last().arrival;
    std::this_thread::sleep_for(milliseconds(uniform(random, 0, 200)));
    comeBack();
    Outcome outcome = awaitReconnect(before, steady_clock::now());
    if (detection > kDetectionMark) {
      outcome.violations.push_back("M: noticed after " + std::to_string(detection.count()) + " ms");
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

/// F8: nobody is there, and then somebody is.
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

/// F16: nothing goes wrong, at many times a camera's rate. Nothing is lost, and memory stays as it is.
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

/// I7: waiting for a robot costs nothing.
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
  // The client waits up to 2 s between two attempts, and then has to connect and get a picture.
  constexpr Milliseconds kLongestWait{2100};
  return {
      {"F1", "split at every offset, twice in either version", 4 * kPictureSize, 4, {}, maker<SplitExperiment>()},
      {"F1b", "drops of 1 and 7 bytes, random pieces, pictures joined", 400, 2, {}, maker<SliceExperiment>()},
      {"F2", "closed amid a picture", 3000, 8, kSoon, maker<EndExperiment>(Action::kClose)},
      {"F3", "reset amid a picture", 3000, 8, kSoon, maker<EndExperiment>(Action::kReset)},
      {"F4", "garbage before or over a header", 1000, 8, kSoon, maker<GarbageExperiment>()},
      {"F4b", "bytes lost, inserted, flipped in or by a header", 1000, 8, kSoon, maker<DamageExperiment>()},
      {"F5", "impossible, shorter and longer sizes", 1000, 8, kSoon, maker<SizeExperiment>()},
      {"F7", "server stopped", 100, 16, kHalfASecond, maker<SilenceExperiment>(Silence::kServerStopped)},
      {"F7b", "black hole that still accepts", 100, 16, kHalfASecond, maker<SilenceExperiment>(Silence::kBlackHole)},
      {"F7c", "nothing comes through, no answer to connect", 100, 16, kHalfASecond,
       maker<SilenceExperiment>(Silence::kUnreachable)},
      {"F8", "server gone for up to 0.3 s", 200, 16, kHalfASecond, maker<AbsenceExperiment>(Absence::kRestart)},
      {"F8b", "port closed for up to 4 s", 100, 16, kLongestWait, maker<AbsenceExperiment>(Absence::kPortClosed)},
      {"F8c", "name unknown for up to 4 s", 100, 16, kLongestWait, maker<AbsenceExperiment>(Absence::kNameUnknown)},
      {"F8d", "turned away for up to 4 s", 100, 16, kLongestWait, maker<AbsenceExperiment>(Absence::kTurnedAway)},
      {"F8e", "robot has another address", 100, 8, Milliseconds(1100), maker<AbsenceExperiment>(Absence::kMoved)},
      {"F16", "a second of 1,000 pictures, nothing wrong", 1200, 2, {}, maker<FastStreamExperiment>()},
      {"I7", "processor time while nobody is there", 12, 1, {}, maker<InTurn<IdleExperiment>>()},
  };
}

}  // namespace fault_bench
