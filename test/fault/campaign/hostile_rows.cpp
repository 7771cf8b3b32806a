// One end of the connection attacks the other.

#include <atomic>
#include <optional>
#include <thread>

#include "aibo_client/rcserver_client.h"
#include "campaign/experiment.h"
#include "hostile/attacks.h"
#include "support/memory_stick.h"
#include "support/picture_server.h"
#include "support/resources.h"
#include "support/simulated_robot.h"

namespace fault_bench {
namespace {

// Long enough for thousands of messages.
constexpr milliseconds kAttackTime{300};

/// A client that wants pictures, joints and sound, and counts what it gets.
class HonestClient {
 public:
  HonestClient(int port, int version) : client_(options(port, version), callbacks()) {
    client_.setStreaming(true);
    client_.setTelemetryPeriod(4);
    client_.setMicrophone({true, 2, 16000});
    client_.start();
  }

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
    options.protocol_version = version == 1 ? 1 : 0;
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

/// hostile-robot: a server attacks the driver's client, then behaves well.
class HostileRobotExperiment : public Experiment {
 public:
  explicit HostileRobotExperiment(unsigned) {}

  Outcome run(unsigned trial, Random& random) override {
    const auto& attack = hostile::robotAttacks()[trial % hostile::robotAttacks().size()];
    PictureServer server(attack.version, milliseconds(5));
    server.setTelemetry(true);
    HonestClient client(server.port(), attack.version);
    if (!client.getsMore()) {
      return {{}, {"no pictures or joints came before the attack"}};
    }
    server.flood(attack.begin(static_cast<unsigned>(random())));
    std::this_thread::sleep_for(kAttackTime);
    server.flood(nullptr);
    const TimePoint end = steady_clock::now();
    if (!client.getsMore()) {
      return {{}, {"pictures and joints do not go on after " + attack.name}};
    }
    return {steady_clock::now() - end, {}};
  }
};

/// hostile-client: clients attack the program aibo_rcserver. In every second trial, another client has its place, and
/// keeps pictures and joints. In the others, such a client comes when the attack has ended.
class HostileClientExperiment : public Experiment {
 public:
  explicit HostileClientExperiment(unsigned /*remainder*/) {
    HonestClient(robot_.port(), 2).getsMore();
    before_ = Resources::of(std::to_string(robot_.process().pid()));
  }

  Outcome run(unsigned trial, Random& random) override {
    const auto& attacks = hostile::clientAttacks();
    const auto& attack = attacks[trial / 2 % attacks.size()];
    std::optional<HonestClient> client;
    if (trial % 2 == 0) {
      client.emplace(robot_.port(), 2);
      client->getsMore();
    }
    output_ = robot_.process().output().size();
    const int port = attack.at_console ? robot_.consolePort() : robot_.port();
    hostile::carryOut(attack, port, random, steady_clock::now() + kAttackTime);
    const TimePoint end = steady_clock::now();
    if (!client) {
      client.emplace(robot_.port(), 2);
    }
    Outcome outcome;
    if (!client->getsMore()) {
      outcome.violations.push_back("a client gets no pictures or joints");
    }
    outcome.recovery = steady_clock::now() - end;
    judge(&outcome);
    for (std::string& violation : outcome.violations) {
      violation += " (" + attack.name + (trial % 2 == 0 ? ", while another client is served)" : ")");
    }
    return outcome;
  }

 private:
  static constexpr std::size_t kMostMemory = 2 * 1024;   // KB more than before all attacks
  static constexpr std::size_t kMostOutput = 64 * 1024;  // bytes for an attack; the console repeats what is typed

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

  test_support::MemoryStick stick_{"ALLOW_MICROPHONE=yes\n"};
  SimulatedRobot robot_{{"--memory-stick", stick_.path().string()}};
  Resources before_;
  std::size_t output_ = 0;
};

}  // namespace

std::vector<Row> hostileRows() {
  const auto robots = static_cast<unsigned>(5 * hostile::robotAttacks().size());
  const auto clients = static_cast<unsigned>(10 * hostile::clientAttacks().size());
  return {
      {"hostile-robot", "a robot attacks the driver's client", robots, 1, maker<HostileRobotExperiment>()},
      {"hostile-client", "clients attack aibo_rcserver", clients, 1, maker<HostileClientExperiment>()},
  };
}

}  // namespace fault_bench
