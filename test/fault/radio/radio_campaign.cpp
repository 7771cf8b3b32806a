/// @file radio_campaign.cpp
/// The client and the real RCServer on two hosts, with an emulated 802.11b link between them: loss, outages, low rates.

#include <algorithm>
#include <boost/program_options.hpp>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "aibo_driver/rcserver_client.h"
#include "radio/network_host.h"
#include "radio/radio_link.h"
#include "radio/robot_on_radio.h"
#include "robot_time/robot_clock.h"
#include "ros/camera/adaptive_stream.h"
#include "support/program.h"

namespace fault_bench {
namespace {

namespace po = boost::program_options;
using std::chrono::milliseconds;
using std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr int kSkipped = 77;  // SKIP_RETURN_CODE of the CTest test

constexpr char kRobotAddress[] = "10.77.0.1";
constexpr char kComputerAddress[] = "10.77.0.2";

/// The stream must begin within this time, whatever the loss.
constexpr std::chrono::seconds kSafetyNet{20};
/// An older picture is stale: it has waited in a socket while nothing got through.
constexpr milliseconds kOldestPicture{1500};

struct Trial {
  std::string title;
  RadioOptions radio;
  milliseconds length{15000};
  milliseconds recovery_mark{0};  ///< the next picture must come within this time after an outage; 0 = no outage
  aibo_driver::PictureTransport transport = aibo_driver::PictureTransport::kTcp;
  bool on_busy_computer = false;  ///< which may hold the client up, so that pictures grow stale
  milliseconds max_age{0};        ///< of a picture; 0 = any. Pictures must not be older for more than a second
  bool is_adaptive = false;       ///< quality and rate are adapted to keep max_age
};

/// The longest time for which pictures may be older than Trial::max_age.
constexpr milliseconds kLongestLate{1000};

/// Adapts quality and rate as the driver does.
class Adapter {
 public:
  Adapter(aibo_driver::RcServerClient& client, milliseconds max_age) : client_(client), stream_({85, 1}, max_age) {}

  void see(const aibo_driver::Picture& picture) {
    const auto taken = clock_.timeOf(picture.connection_number, *picture.frame_number, picture.first_byte_time);
    const auto now = steady_clock::now();
    if (const auto step = stream_.pictureArrived(now, now - taken)) {
      client_.setJpegQuality(step->jpeg_quality);
      client_.setStreamFormat({aibo_driver::Resolution::kHigh, step->every_nth_image});
      changes_.push_back(std::to_string(step->jpeg_quality) + "/" + std::to_string(step->every_nth_image));
    }
  }

  /// Quality and every n-th image of all changes.
  const std::vector<std::string>& changes() const { return changes_; }

 private:
  aibo_driver::RcServerClient& client_;
  aibo_driver::robot_time::RobotClock clock_;
  aibo_driver::node::AdaptiveStream stream_;
  std::vector<std::string> changes_;
};

struct Sighting {
  RobotOnRadio::Sent sent;
  steady_clock::time_point seen_at;
};

/// Records and checks what the client delivers.
class Observer {
 public:
  explicit Observer(const RobotOnRadio& robot) : robot_(robot) {}

  void see(const aibo_driver::Picture& picture) {
    const auto now = steady_clock::now();
    const auto sent = robot_.find(picture.jpeg);
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!sent) {
      violations_.insert("a picture that was never sent");
      return;
    }
    if (!sightings_.empty() && sent->number <= sightings_.back().sent.number) {
      violations_.insert("a picture that is not newer than the one before");
    }
    if (now - sent->image_at > kOldestPicture) {
      violations_.insert("a stale picture");
    }
    sightings_.push_back({*sent, now});
  }

  std::vector<Sighting> sightings() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return sightings_;
  }

  std::set<std::string> violations() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return violations_;
  }

 private:
  const RobotOnRadio& robot_;
  mutable std::mutex mutex_;  // guards what follows
  std::vector<Sighting> sightings_;
  std::set<std::string> violations_;
};

struct Result {
  double pictures_per_second = 0;
  std::vector<double> ages;  ///< ms, sorted: from the camera's image to its delivery
  double longest_gap = 0;    ///< ms, between pictures
  double recovery = -1;      ///< ms, from the end of the last outage to the next picture; -1 = no outage
  std::uint64_t connections = 0;
  std::string transport_problem;     ///< why pictures came by TCP instead of UDP
  double longest_late = 0;           ///< ms, for which pictures were older than the limit
  std::vector<std::string> changes;  ///< of quality and rate
  std::set<std::string> violations;
};

double quantile(const std::vector<double>& sorted, double part) {
  const auto index = static_cast<std::size_t>(part * static_cast<double>(sorted.size()));
  return sorted.empty() ? 0 : sorted[std::min(index, sorted.size() - 1)];
}

void measureRecovery(const Trial& trial, const std::vector<Sighting>& sightings, steady_clock::time_point begin,
                     Result& result) {
  if (trial.radio.outages.empty()) {
    return;
  }
  const auto back_at = begin + trial.radio.outages.back().begin + trial.radio.outages.back().length;
  const auto first = std::find_if(sightings.begin(), sightings.end(),
                                  [back_at](const Sighting& sighting) { return sighting.seen_at >= back_at; });
  if (first == sightings.end()) {
    result.violations.insert("no picture after the outage");
    return;
  }
  result.recovery = Milliseconds(first->seen_at - back_at).count();
  if (result.recovery > static_cast<double>(trial.recovery_mark.count())) {
    result.violations.insert("no picture within " + std::to_string(trial.recovery_mark.count()) +
                             " ms after the outage");
  }
}

void measureLateness(const Trial& trial, const std::vector<Sighting>& sightings, Result& result) {
  const Sighting* first_late = nullptr;
  for (const Sighting& sighting : sightings) {
    if (sighting.seen_at - sighting.sent.image_at <= trial.max_age) {
      first_late = nullptr;
      continue;
    }
    first_late = first_late != nullptr ? first_late : &sighting;
    result.longest_late = std::max(result.longest_late, Milliseconds(sighting.seen_at - first_late->seen_at).count());
  }
  if (trial.is_adaptive && result.longest_late > static_cast<double>(kLongestLate.count())) {
    result.violations.insert("pictures older than the limit for more than a second");
  }
}

/// @param stale number of pictures that the client may have left out because this computer held it up
Result evaluate(const Trial& trial, const Observer& observer, steady_clock::time_point begin, std::uint64_t stale) {
  Result result;
  const std::vector<Sighting> sightings = observer.sightings();
  result.violations = observer.violations();
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    result.ages.push_back(Milliseconds(sightings[i].seen_at - sightings[i].sent.image_at).count());
    if (i > 0) {
      const double gap = Milliseconds(sightings[i].seen_at - sightings[i - 1].seen_at).count();
      result.longest_gap = std::max(result.longest_gap, gap);
    }
  }
  std::sort(result.ages.begin(), result.ages.end());
  result.pictures_per_second =
      static_cast<double>(sightings.size()) / std::chrono::duration<double>(trial.length).count();
  measureRecovery(trial, sightings, begin, result);
  if (trial.max_age.count() > 0) {
    measureLateness(trial, sightings, result);
  }
  if (sightings.empty()) {
    result.violations.insert("no picture at all");
  } else if (trial.max_age.count() == 0 && trial.radio.loss == 0 && trial.radio.outages.empty() &&
             sightings.back().sent.number - sightings.front().sent.number + 1 > sightings.size() + stale) {
    result.violations.insert("pictures lost on a link without loss");
  }
  return result;
}

Result run(const Trial& trial) {
  const NetworkHost robot_host(kRobotAddress);
  const NetworkHost computer(kComputerAddress);
  const RobotOnRadio robot(robot_host);
  Observer observer(robot);
  Result result;
  std::thread([&] {
    computer.enter();
    const RadioLink link(robot_host, computer, trial.radio);
    aibo_driver::ClientOptions options;
    options.host = kRobotAddress;
    options.picture_transport = trial.transport;
    std::optional<Adapter> adapter;
    aibo_driver::RcServerClient::Callbacks callbacks;
    callbacks.on_picture = [&](const aibo_driver::PicturePtr& picture) {
      observer.see(*picture);
      if (adapter) {
        adapter->see(*picture);
      }
    };
    aibo_driver::RcServerClient client(options, callbacks);
    if (trial.is_adaptive) {
      adapter.emplace(client, trial.max_age);
    }
    client.setStreaming(true);
    client.start();
    std::this_thread::sleep_until(link.begin() + trial.length);  // the length is what the rates are measured over
    const auto deadline = steady_clock::now() + kSafetyNet;
    while (observer.sightings().empty() && steady_clock::now() < deadline) {
      std::this_thread::sleep_for(milliseconds(10));
    }
    const std::string transport_problem = client.status().transport_problem;
    client.stop();
    const aibo_driver::ClientStatistics statistics = client.statistics();
    result = evaluate(trial, observer, link.begin(), trial.on_busy_computer ? statistics.stale_pictures : 0);
    result.transport_problem = transport_problem;
    result.connections = statistics.connections;
    if (adapter) {
      result.changes = adapter->changes();
    }
  }).join();
  return result;
}

/// The same by UDP.
Trial byUdp(Trial trial) {
  trial.transport = aibo_driver::PictureTransport::kUdp;
  trial.title += ", UDP";
  return trial;
}

Trial lossTrial(double bits_per_second, double loss, std::uint32_t seed, milliseconds length) {
  Trial trial;
  trial.radio.bits_per_second = bits_per_second;
  trial.radio.loss = loss;
  trial.radio.seed = seed;
  trial.length = length;
  char title[64];
  std::snprintf(title, sizeof title, "%4.1f Mbit/s, loss %g %%, seed %u", bits_per_second / 1e6, loss * 100, seed);
  trial.title = title;
  return trial;
}

Trial outageTrial(milliseconds outage, std::uint32_t seed, milliseconds recovery_mark) {
  Trial trial;
  trial.radio.seed = seed;
  trial.radio.outages = {{milliseconds(2000), outage}};
  trial.length = outage + milliseconds(7000);
  trial.recovery_mark = recovery_mark;
  char title[64];
  std::snprintf(title, sizeof title, "11 Mbit/s, outage of %g s, seed %u", static_cast<double>(outage.count()) / 1e3,
                seed);
  trial.title = title;
  return trial;
}

std::vector<Trial> allTrials(std::uint32_t first_seed) {
  std::vector<Trial> trials;
  for (std::uint32_t seed = first_seed; seed < first_seed + 3; ++seed) {
    for (const double loss : {0.0, 0.01, 0.05}) {
      trials.push_back(lossTrial(11e6, loss, seed, milliseconds(15000)));
    }
    // After a short outage the robot still serves the old connection, until its client proves by its token that it is
    // the same. After a longer one it has given up the old connection.
    trials.push_back(outageTrial(milliseconds(1000), seed, milliseconds(500)));
    trials.push_back(outageTrial(milliseconds(3000), seed, milliseconds(500)));
    trials.push_back(outageTrial(milliseconds(10000), seed, milliseconds(500)));
  }
  for (const double rate : {5.5e6, 2e6, 1e6}) {
    trials.push_back(lossTrial(rate, 0, first_seed, milliseconds(15000)));
  }
  return trials;
}

/// TCP and UDP in turn, over the same links.
std::vector<Trial> comparedTrials(std::uint32_t seed) {
  std::vector<Trial> trials;
  for (const double rate : {11e6, 2e6, 1e6}) {
    for (const double loss : {0.0, 0.01, 0.05, 0.1}) {
      const Trial trial = lossTrial(rate, loss, seed, milliseconds(10000));
      trials.push_back(trial);
      trials.push_back(byUdp(trial));
    }
  }
  for (const milliseconds outage : {milliseconds(1000), milliseconds(3000)}) {
    const Trial trial = outageTrial(outage, seed, milliseconds(2000));
    trials.push_back(trial);
    trials.push_back(byUdp(trial));
  }
  return trials;
}

/// The same links with and without adaptive quality and rate.
std::vector<Trial> adaptiveTrials(std::uint32_t first_seed) {
  std::vector<Trial> trials;
  for (const double rate : {1e6, 2e6, 11e6}) {
    for (const double loss : {0.0, 0.01}) {
      for (const bool is_adaptive : {true, false}) {
        Trial trial = lossTrial(rate, loss, first_seed, milliseconds(rate < 2e6 ? 120000 : 30000));
        trial.title += is_adaptive ? ", adaptive" : "";
        trial.max_age = milliseconds(150);
        trial.is_adaptive = is_adaptive;
        trials.push_back(trial);
      }
    }
  }
  return trials;
}

/// With a generous limit for recovery, because the machine may be busy.
std::vector<Trial> shortTrials(std::uint32_t seed) {
  std::vector<Trial> trials = {lossTrial(11e6, 0, seed, milliseconds(2000)),
                               lossTrial(11e6, 0.05, seed, milliseconds(3000)),
                               outageTrial(milliseconds(1000), seed, milliseconds(5000)),
                               byUdp(lossTrial(11e6, 0.05, seed, milliseconds(3000)))};
  for (Trial& trial : trials) {
    trial.on_busy_computer = true;
  }
  return trials;
}

bool print(const Trial& trial, const Result& result) {
  std::printf("%-40s %5.1f %7.1f %7.1f %7.1f %8.1f ", trial.title.c_str(), result.pictures_per_second,
              quantile(result.ages, 0.5), quantile(result.ages, 0.99), quantile(result.ages, 1), result.longest_gap);
  result.recovery < 0 ? std::printf("%9s", "-") : std::printf("%9.1f", result.recovery);
  std::printf(" %6llu %10zu\n", static_cast<unsigned long long>(result.connections), result.violations.size());
  if (!result.transport_problem.empty()) {
    std::printf("  by TCP in the end: %s\n", result.transport_problem.c_str());
  }
  if (trial.max_age.count() > 0) {
    std::printf("  older than %lld ms for at most %.0f ms; changes:", static_cast<long long>(trial.max_age.count()),
                result.longest_late);
    for (const std::string& change : result.changes) {
      std::printf(" %s", change.c_str());
    }
    std::printf("\n");
  }
  for (const std::string& violation : result.violations) {
    std::printf("  VIOLATION: %s\n", violation.c_str());
  }
  std::fflush(stdout);
  return result.violations.empty();
}

int runAll(const std::vector<Trial>& trials) {
  std::printf("%-40s %5s %7s %7s %7s %8s %9s %6s %10s\n", "", "fps", "p50 ms", "p99 ms", "max ms", "gap ms", "back ms",
              "conns", "violations");
  bool all_well = true;
  for (const Trial& trial : trials) {
    all_well = print(trial, run(trial)) && all_well;
  }
  return all_well ? EXIT_SUCCESS : EXIT_FAILURE;
}

/// Which trials to run. Without a choice, all but those that compare.
struct Choice {
  bool short_form = false;
  bool compare = false;
  bool adaptive = false;
};

std::vector<Trial> chosenTrials(const Choice& choice, std::uint32_t seed) {
  return choice.compare      ? comparedTrials(seed)
         : choice.adaptive   ? adaptiveTrials(seed)
         : choice.short_form ? shortTrials(seed)
                             : allTrials(seed);
}

po::options_description describe(std::uint32_t* seed, Choice* choice) {
  po::options_description description("Options", 120);
  // clang-format off
  description.add_options()
    ("seed", po::value(seed)->default_value(1), "seed of loss and jitter; the campaign tries this one and the next two")
    ("compare", po::bool_switch(&choice->compare),
     "TCP and UDP over the same links, at 11, 2 and 1 Mbit/s with up to 10 % loss")
    ("adaptive", po::bool_switch(&choice->adaptive), "only weak links with and without adaptive quality and rate")
    ("short", po::bool_switch(&choice->short_form), "a few seconds only, for the test run");
  // clang-format on
  return description;
}

}  // namespace
}  // namespace fault_bench

int main(int argc, char** argv) {
  std::uint32_t seed = 1;
  fault_bench::Choice choice;
  return test_support::runProgram(
      argc, argv,
      "Driver and robot over an emulated 802.11b link: how many pictures come, how old they are (from the camera's\n"
      "image to their delivery), and when they come again after an outage. Needs root.",
      fault_bench::describe(&seed, &choice), [&] {
        try {
          return fault_bench::runAll(fault_bench::chosenTrials(choice, seed));
        } catch (const fault_bench::NoNetworkHosts& problem) {
          std::cout << "Skipped: " << problem.what() << "\n";
          return fault_bench::kSkipped;
        }
      });
}
