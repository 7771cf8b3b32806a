// Hostile clients.

#include <algorithm>
#include <memory>
#include <optional>
#include <system_error>
#include <thread>

#include "campaign/experiment.h"
#include "support/memory_stick.h"
#include "support/raw_client.h"
#include "support/resources.h"
#include "support/simulated_robot.h"
#include "support/version2_frames.h"

namespace fault_bench {
namespace {

// Long enough for thousands of messages.
constexpr milliseconds kAttackTime{300};

const std::string kVersion2 = {'X', 2};

// A frame's header for version 2.
std::string header(char kind, unsigned size) {
  protocol::version2::FrameHeader fields = {};
  fields.kind = kind;
  fields.request_number = 1;
  fields.payload_size = size;
  const Bytes bytes = version2_frames::encoded(fields);
  return {bytes.begin(), bytes.end()};
}

std::string anyBytes(Random& random, int most) {
  std::string bytes(static_cast<std::size_t>(std::uniform_int_distribution<int>(1, most)(random)), '\0');
  std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<char>(random()); });
  return bytes;
}

std::string anyRequest(Random& random) {
  static const std::string kinds = "HFWJVTIKLPUDNQRXZGMYBA";  // the motors stay on
  const std::string payload = anyBytes(random, 300);
  return header(kinds[random() % kinds.size()], static_cast<unsigned>(payload.size())) + payload;
}

std::string anySize(Random& random) {
  return header('U', static_cast<unsigned>(random()) | 0x10000U);
}

/// The server may have turned the client away. Then there is no connection.
std::unique_ptr<RawClient> connectTo(int port, const std::string& first) {
  try {
    auto client = std::make_unique<RawClient>(port);
    return client->send(first) >= 0 ? std::move(client) : nullptr;
  } catch (const std::system_error&) {
    return nullptr;
  }
}

/// An attack of clients.
struct ClientAttack {
  std::string name;
  bool at_console;  ///< not at the server's port
  int clients;      ///< at the same time
  bool reads;       ///< whether they read the answers
  std::string first;
  std::function<std::string(Random& random)> more;  ///< what they send again and again; null: they wait
};

const std::vector<ClientAttack> kAttacks = {
    {"nonsense", false, 1, true, "", [](Random& random) { return anyBytes(random, 5000); }},
    {"payloads", false, 1, true, kVersion2, anyRequest},
    {"sizes", false, 1, true, kVersion2, anySize},
    {"unread", false, 1, false, kVersion2, [](Random&) { return header('H', 0) + header('N', 0); }},
    {"half", false, 1, false, kVersion2 + header('U', 60000), nullptr},
    {"connections", false, 100, false, "", nullptr},
    {"console-commands", true, 1, true, "", [](Random& random) { return anyBytes(random, 60) + "\n"; }},
    {"console-listeners", true, 20, false, "", nullptr},
};

/// Attacks a port of 127.0.0.1 until `end`. When the server ends a connection, the attacker makes a new one.
void carryOut(const ClientAttack& attack, int port, Random& random, TimePoint end) {
  std::vector<std::unique_ptr<RawClient>> clients(static_cast<std::size_t>(attack.clients));
  do {
    for (auto& client : clients) {
      if (!client) {
        client = connectTo(port, attack.first);
      }
      const bool is_open = client && (!attack.more || client->send(attack.more(random)) >= 0);
      const auto answer = is_open && attack.reads ? client->receive(milliseconds(0)) : std::nullopt;
      if (!is_open || (answer && answer->empty())) {
        client.reset();  // the server has ended the connection
      }
    }
    if (!attack.reads) {
      std::this_thread::sleep_for(milliseconds(1));  // nothing more can be sent soon
    }
  } while (steady_clock::now() < end);
}

/// hostile-client: clients attack the program aibo_rcserver. In every second trial, another client has its place, and
/// keeps pictures and joints. In the others, such a client comes when the attack has ended.
class HostileClientExperiment : public Experiment {
 public:
  explicit HostileClientExperiment(unsigned /*remainder*/) {
    CountingClient(robot_.port()).getsMore();
    before_ = Resources::of(std::to_string(robot_.process().pid()));
  }

  Outcome run(unsigned trial, Random& random) override {
    const ClientAttack& attack = kAttacks[trial / 2 % kAttacks.size()];
    std::optional<CountingClient> client;
    if (trial % 2 == 0) {
      client.emplace(robot_.port());
      client->getsMore();
    }
    output_ = robot_.process().output().size();
    const int port = attack.at_console ? robot_.consolePort() : robot_.port();
    carryOut(attack, port, random, steady_clock::now() + kAttackTime);
    const TimePoint end = steady_clock::now();
    if (!client) {
      client.emplace(robot_.port());
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
  const auto trials = static_cast<unsigned>(10 * kAttacks.size());
  return {{"hostile-client", "clients attack aibo_rcserver", trials, 1, maker<HostileClientExperiment>()}};
}

}  // namespace fault_bench
