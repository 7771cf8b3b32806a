// hostile-robot, hostile-client: one end of the connection attacks the other.

#include <time.h>

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include "aibo_client/rcserver_client.h"
#include "campaign/experiment.h"
#include "campaign/interposers.h"
#include "hostile/attacks.h"
#include "support/memory_stick.h"
#include "support/picture_server.h"
#include "support/resources.h"
#include "support/simulated_robot.h"

using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace fault_bench {
namespace {

// Long enough for thousands of messages.
constexpr milliseconds kAttackTime{300};

// Once as much as may be logged at once, and one line a second.
constexpr std::size_t kMostLines = 30;
constexpr std::size_t kLongestLine = 1200;

/// A client that wants pictures, joints and sound, and counts what it gets.
class HonestClient {
 public:
  HonestClient(int port, int version, int mark) : client_(options(port, version), callbacks(mark)) {
    client_.setStreaming(true);
    client_.setTelemetryPeriod(4);
    client_.setMicrophone({true, 2, 16000});
    client_.start();
  }

  /// Waits for pictures and joints that come from now on.
  /// @return false if they do not come
  bool getsMore() {
    std::unique_lock<std::mutex> lock(mutex_);
    const std::uint64_t pictures = pictures_;
    const std::uint64_t joints = joints_;
    return changed_.wait_for(lock, kPatience, [&] { return pictures_ > pictures + 1 && joints_ > joints + 1; });
  }

  aibo_client::ClientStatistics statistics() const { return client_.statistics(); }

  /// Where a joint was last measured.
  std::optional<double> position(int joint) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = positions_.find(joint);
    return found == positions_.end() ? std::nullopt : std::optional<double>(found->second);
  }

  /// What the client should not have done.
  std::vector<std::string> complaints() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<std::string> complaints;
    if (lines_ > kMostLines) {
      complaints.push_back(std::to_string(lines_) + " lines were logged");
    }
    if (longest_line_ > kLongestLine) {
      complaints.push_back("a line of " + std::to_string(longest_line_) + " bytes was logged");
    }
    if (farthest_ > kFarthest) {
      complaints.push_back("a position of " + std::to_string(farthest_) + " rad was delivered");
    }
    return complaints;
  }

 private:
  static constexpr double kFarthest = 4;  // rad; no joint of any robot goes so far

  static aibo_client::ClientOptions options(int port, int version) {
    aibo_client::ClientOptions options;
    options.port = port;
    options.protocol_version = version == 1 ? 1 : 0;
    return options;
  }

  aibo_client::Callbacks callbacks(int mark) {
    aibo_client::Callbacks callbacks;
    callbacks.on_status = [mark](const aibo_client::ConnectionStatus&) { interposers::markThisThread(mark); };
    callbacks.on_picture = [this](const aibo_client::PicturePtr&) { count([this] { ++pictures_; }); };
    callbacks.on_telemetry = [this](const aibo_client::Telemetry& telemetry) {
      count([&] {
        joints_ += telemetry.joints.empty() ? 0 : 1;
        for (const aibo_client::JointReading& joint : telemetry.joints) {
          positions_[joint.id] = joint.position;
          // A joint that is not in the tables may be anywhere.
          farthest_ = joint.id == 99 ? farthest_ : std::max(farthest_, std::abs(joint.position));
        }
      });
    };
    callbacks.log = [this](aibo_client::LogLevel, const std::string& line) {
      count([&] {
        ++lines_;
        longest_line_ = std::max(longest_line_, line.size());
      });
    };
    return callbacks;
  }

  template <typename Change>
  void count(const Change& change) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      change();
    }
    changed_.notify_all();
  }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t pictures_ = 0;
  std::uint64_t joints_ = 0;
  std::map<int, double> positions_;
  double farthest_ = 0;
  std::size_t lines_ = 0;
  std::size_t longest_line_ = 0;
  aibo_client::RcServerClient client_;
};

/// hostile-robot: a server attacks the driver's client, then behaves well.
class HostileRobotExperiment : public Experiment {
 public:
  explicit HostileRobotExperiment(unsigned) {}

  Outcome run(unsigned trial, Random& random) override {
    const auto& attack = hostile::robotAttacks()[trial % hostile::robotAttacks().size()];
    PictureServer server(attack.version, milliseconds(5));
    server.setTelemetry(true);
    HonestClient client(server.port(), attack.version, kMark);
    Outcome outcome;
    if (!client.getsMore()) {
      return {{}, {"no pictures or joints came before the attack"}};
    }
    interposers::takeLargestAllocation(kMark);
    const aibo_client::ClientStatistics before = client.statistics();
    const std::size_t memory = Resources::of().resident_kilobytes;
    const Milliseconds work = interposers::processorTime(kMark);
    const TimePoint begin = steady_clock::now();
    server.misbehave(attack.begin(static_cast<unsigned>(random())));
    std::this_thread::sleep_for(kAttackTime);
    server.misbehave({});
    const TimePoint end = steady_clock::now();
    if (!client.getsMore()) {
      outcome.violations.push_back("pictures and joints do not go on");
    }
    outcome.recovery = steady_clock::now() - end;
    judge(client, before, end - begin, memory, &outcome);
    judgeWork(interposers::processorTime(kMark) - work, client.statistics().bytes_received - before.bytes_received,
              &outcome);
    for (std::string& violation : outcome.violations) {
      violation += " (" + attack.name + ", version " + std::to_string(attack.version) + ")";
    }
    return outcome;
  }

 private:
  static constexpr int kMark = 1;
  static constexpr std::size_t kMostAtOnce = 1024 * 1024;  // bytes, as in I10
  static constexpr std::size_t kMostMemory = 8 * 1024;     // KB; pictures and texts under way, of client and server
  static constexpr Milliseconds kWorkPerKilobyte{0.4};     // received; of processor time
  static constexpr Milliseconds kWork{100};                // for anything else

  static void judge(const HonestClient& client, const aibo_client::ClientStatistics& before, Milliseconds time,
                    std::size_t memory, Outcome* outcome) {
    outcome->violations = client.complaints();
    const aibo_client::ClientStatistics after = client.statistics();
    // Twice the rate, and a burst for each connection.
    const double seconds = (time + *outcome->recovery).count() / 1000;
    const double most = 2 * 31.25 * seconds + 64 * static_cast<double>(after.connections - before.connections + 1);
    const auto measured = static_cast<double>(after.telemetry - before.telemetry);
    if (measured > most + 1) {
      outcome->violations.push_back(std::to_string(measured) + " measurements were delivered");
    }
    // Twice the frames, and a second for each connection.
    const double most_sounds =
        2 * 125 * seconds + 125 * static_cast<double>(after.connections - before.connections + 1);
    if (const auto sounds = static_cast<double>(after.sounds - before.sounds); sounds > most_sounds) {
      outcome->violations.push_back(std::to_string(sounds) + " pieces of sound were delivered");
    }
    if (const std::size_t size = interposers::takeLargestAllocation(kMark); size > kMostAtOnce) {
      outcome->violations.push_back("the client has allocated " + std::to_string(size) + " bytes at once");
    }
    const std::size_t now = Resources::of().resident_kilobytes;
    if (kMemoryCounts && now > memory + kMostMemory) {
      outcome->violations.push_back(std::to_string(now - memory) + " KB more memory are used");
    }
  }

  static void judgeWork(Milliseconds work, std::uint64_t bytes, Outcome* outcome) {
    const Milliseconds most = kWork + kWorkPerKilobyte * (static_cast<double>(bytes) / 1024);
    if (work > most) {
      outcome->violations.push_back("M: the client worked for " + std::to_string(work.count()) + " ms on " +
                                    std::to_string(bytes) + " bytes");
    }
  }
};

/// Processor time of a process.
Milliseconds processorTime(pid_t process) {
  clockid_t clock = 0;
  timespec time = {};
  if (::clock_getcpuclockid(process, &clock) == 0) {
    ::clock_gettime(clock, &time);
  }
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

/// hostile-client: clients attack the program aibo_rcserver. In every second trial, another client has its place, and
/// keeps pictures and joints meanwhile. In the others, such a client comes when the attack has ended.
class HostileClientExperiment : public Experiment {
 public:
  explicit HostileClientExperiment(unsigned remainder) : mark_(static_cast<int>(remainder) + 1) {
    HonestClient(robot_.port(), 2, mark_).getsMore();
    before_ = Resources::of(std::to_string(robot_.process().pid()));
  }

  Outcome run(unsigned trial, Random& random) override {
    const auto& attacks = hostile::clientAttacks();
    const auto& attack = attacks[trial / 2 % attacks.size()];
    Outcome outcome = trial % 2 == 0 ? attackWhileServing(attack, random) : attackAlone(attack, random);
    judge(&outcome);
    for (std::string& violation : outcome.violations) {
      violation += " (" + attack.name + (trial % 2 == 0 ? ", while another client is served)" : ")");
    }
    return outcome;
  }

 private:
  static constexpr std::size_t kMostMemory = 2 * 1024;   // KB more than before all attacks
  static constexpr std::size_t kMostOutput = 64 * 1024;  // bytes for an attack; the console repeats what is typed
  static constexpr int kTailTilt = 52;
  static constexpr double kStill = 0.05;  // rad

  /// @return the share of a processor that the server used
  double carryOut(const hostile::ClientAttack& attack, Random& random) {
    const Milliseconds used = processorTime(robot_.process().pid());
    const TimePoint begin = steady_clock::now();
    output_ = robot_.process().output().size();
    attack.run({robot_.port(), robot_.consolePort()}, random, begin + kAttackTime);
    return (processorTime(robot_.process().pid()) - used) / Milliseconds(steady_clock::now() - begin);
  }

  Outcome attackWhileServing(const hostile::ClientAttack& attack, Random& random) {
    HonestClient client(robot_.port(), 2, mark_);
    if (!client.getsMore()) {
      return {{}, {"no pictures or joints came before the attack"}};
    }
    Outcome outcome;
    const std::uint64_t connections = client.statistics().connections;
    const std::uint64_t pictures = client.statistics().pictures;
    const std::optional<double> tail = client.position(kTailTilt);
    const double load = carryOut(attack, random);
    if (client.statistics().pictures == pictures) {
      outcome.violations.push_back("M: no picture came during the attack");
    }
    if (!client.getsMore()) {
      outcome.violations.push_back("pictures and joints do not go on");
    }
    if (client.statistics().connections != connections) {
      outcome.violations.push_back("M: the client has lost its place");
    }
    if (!tail || std::abs(*client.position(kTailTilt) - *tail) > kStill) {
      outcome.violations.push_back("the tail has moved");
    }
    if (load > 1.2) {
      outcome.violations.push_back("M: the server took " + std::to_string(load) + " processors");
    }
    return outcome;
  }

  Outcome attackAlone(const hostile::ClientAttack& attack, Random& random) {
    Outcome outcome;
    carryOut(attack, random);
    const TimePoint end = steady_clock::now();
    HonestClient client(robot_.port(), 2, mark_);
    if (!client.getsMore()) {
      outcome.violations.push_back("a client is not served any more");
    }
    outcome.recovery = steady_clock::now() - end;
    return outcome;
  }

  void judge(Outcome* outcome) {
    if (!robot_.isRunning()) {
      outcome->violations.push_back("the server has ended: " + robot_.process().output());
      robot_.restart();
      return;
    }
    const std::size_t output = robot_.process().output().size() - output_;
    if (output > kMostOutput) {
      outcome->violations.push_back("the server has printed " + std::to_string(output) + " bytes");
    }
    const Resources now = Resources::of(std::to_string(robot_.process().pid()));
    if (kMemoryCounts && now.resident_kilobytes > before_.resident_kilobytes + kMostMemory) {
      outcome->violations.push_back("the server uses " +
                                    std::to_string(now.resident_kilobytes - before_.resident_kilobytes) +
                                    " KB more memory than before all attacks");
    }
  }

  const int mark_;
  test_support::MemoryStick stick_{"ALLOW_MICROPHONE=yes\n"};
  SimulatedRobot robot_{{"--memory-stick", stick_.path().string()}};
  Resources before_;
  std::size_t output_ = 0;
};

}  // namespace

std::vector<Row> hostileRows() {
  // The longest wait between two attempts to connect, and a version 2 that is not answered.
  constexpr Milliseconds kRobotMark{3200};
  // A client that sends half a request keeps the place for 2 s after its last byte, or until it is closed.
  constexpr Milliseconds kClientMark{3000};
  const auto robot = static_cast<unsigned>(hostile::robotAttacks().size());
  const auto clients = static_cast<unsigned>(2 * hostile::clientAttacks().size());
  return {
      {"hostile-robot", "a robot attacks the driver's client", 5 * robot, 1, kRobotMark,
       maker<HostileRobotExperiment>()},
      {"hostile-client", "clients attack aibo_rcserver", 5 * clients, 1, kClientMark, maker<HostileClientExperiment>()},
  };
}

}  // namespace fault_bench
