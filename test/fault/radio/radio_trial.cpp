#include "radio/radio_trial.h"

#include <algorithm>
#include <cstdio>
#include <mutex>
#include <optional>
#include <thread>

#include "radio/network_host.h"
#include "radio/radio_link.h"
#include "robot_server.h"
#include "support/safety_net.h"

namespace fault_bench {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using test_support::kSafetyNet;
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr char kRobotAddress[] = "10.77.0.1";
constexpr char kComputerAddress[] = "10.77.0.2";

struct Sighting {
  RobotServer::Encoded picture;
  steady_clock::time_point seen_at;
};

/// Records and checks what the client delivers.
class Observer {
 public:
  explicit Observer(const RobotServer& robot) : robot_(robot) {}

  void see(const aibo_client::Picture& picture) {
    const auto now = steady_clock::now();
    const auto encoded = robot_.find(picture.jpeg);
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!encoded) {
      violations_.insert("a picture that the robot has not taken");
      return;
    }
    if (!sightings_.empty() && encoded->number <= sightings_.back().picture.number) {
      violations_.insert("a picture that is not newer than the one before");
    }
    sightings_.push_back({*encoded, now});
  }

  std::vector<Sighting> sightings() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return sightings_;
  }

  /// Whether a picture has come since then.
  bool hasSeenSince(steady_clock::time_point time) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return !sightings_.empty() && sightings_.back().seen_at >= time;
  }

  std::set<std::string> violations() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return violations_;
  }

 private:
  const RobotServer& robot_;
  mutable std::mutex mutex_;  // guards what follows
  std::vector<Sighting> sightings_;
  std::set<std::string> violations_;
};

/// The end of the last outage, since the beginning of the link; 0 without any.
milliseconds endOfOutages(const Trial& trial) {
  return trial.radio.outages.empty() ? milliseconds(0)
                                     : trial.radio.outages.back().begin + trial.radio.outages.back().length;
}

void measureRecovery(const Trial& trial, Result& result) {
  if (trial.radio.outages.empty()) {
    return;
  }
  const double back_at = std::chrono::duration<double>(endOfOutages(trial)).count();
  const auto first = std::find_if(result.deliveries.begin(), result.deliveries.end(),
                                  [back_at](const Result::Delivery& delivery) { return delivery.time >= back_at; });
  if (first == result.deliveries.end()) {
    result.violations.insert("no picture after the outage");
    return;
  }
  result.recovery = 1e3 * (first->time - back_at);
}

Result evaluate(const Trial& trial, const Observer& observer, steady_clock::time_point begin,
                const aibo_client::ClientStatistics& client) {
  Result result;
  result.connections = client.connections;
  const std::vector<Sighting> sightings = observer.sightings();
  result.violations = observer.violations();
  for (const Sighting& sighting : sightings) {
    result.deliveries.push_back({std::chrono::duration<double>(sighting.seen_at - begin).count(),
                                 Milliseconds(sighting.seen_at - sighting.picture.image_at).count()});
  }
  summarize(trial, result);
  return result;
}

}  // namespace

double quantile(const std::vector<double>& sorted, double part) {
  const auto index = static_cast<std::size_t>(part * static_cast<double>(sorted.size()));
  return sorted.empty() ? 0 : sorted[std::min(index, sorted.size() - 1)];
}

void summarize(const Trial& trial, Result& result) {
  const std::vector<Result::Delivery>& deliveries = result.deliveries;
  if (deliveries.empty()) {
    result.violations.insert("no picture at all");
    return;
  }
  for (std::size_t i = 0; i < deliveries.size(); ++i) {
    result.ages.push_back(deliveries[i].age);
    const double gap = i > 0 ? deliveries[i].time - deliveries[i - 1].time : 0;
    result.longest_gap = std::max(result.longest_gap, 1e3 * gap);
  }
  std::sort(result.ages.begin(), result.ages.end());
  const double length = std::chrono::duration<double>(trial.length).count();
  result.pictures_per_second = static_cast<double>(deliveries.size()) / (length - deliveries.front().time);
  measureRecovery(trial, result);
}

Result run(const Trial& trial) {
  const NetworkHost robot_host(kRobotAddress);
  const NetworkHost computer(kComputerAddress);
  const RobotServer robot(robot_host.address(), RobotServer::kRobotPort, [&robot_host] { robot_host.enter(); });
  Observer observer(robot);
  Result result;
  std::thread([&] {
    computer.enter();
    const RadioLink link(robot_host, computer, trial.radio);
    aibo_client::ClientOptions options;
    options.host = kRobotAddress;
    options.picture_transport = trial.transport;
    aibo_client::Callbacks callbacks;
    callbacks.on_picture = [&](const aibo_client::PicturePtr& picture) { observer.see(*picture); };
    aibo_client::RcServerClient client(options, callbacks);
    client.setStreaming(true);
    client.start();
    std::optional<aibo_client::RcServerClient> rival;
    if (trial.has_rival) {
      client.waitForConnection(kSafetyNet);
      rival.emplace(options, aibo_client::Callbacks());
      rival->start();
    }
    std::this_thread::sleep_until(link.begin() + trial.length);  // the rates are measured over this length
    const auto deadline = steady_clock::now() + kSafetyNet;
    while (!observer.hasSeenSince(link.begin() + endOfOutages(trial)) && steady_clock::now() < deadline) {
      std::this_thread::sleep_for(milliseconds(10));
    }
    const std::string transport_problem = client.status().transport_problem;
    if (rival) {
      rival->stop();
    }
    client.stop();
    result = evaluate(trial, observer, link.begin(), client.statistics());
    result.transport_problem = transport_problem;
    if (rival && result.connections > 1) {
      result.violations.insert("another program got the place of a client that was there");
    }
  }).join();
  return result;
}

Trial withRival(Trial trial) {
  trial.has_rival = true;
  trial.title += ", rival";
  return trial;
}

Trial by(aibo_client::PictureTransport transport, Trial trial) {
  using aibo_client::PictureTransport;
  trial.transport = transport;
  trial.title += transport == PictureTransport::kTcp ? "" : transport == PictureTransport::kUdp ? ", UDP" : ", auto";
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

Trial outageTrial(milliseconds outage, std::uint32_t seed) {
  Trial trial;
  trial.radio.seed = seed;
  trial.radio.outages = {{milliseconds(2000), outage}};
  trial.length = outage + milliseconds(7000);
  char title[64];
  std::snprintf(title, sizeof title, "11 Mbit/s, outage of %g s, seed %u", static_cast<double>(outage.count()) / 1e3,
                seed);
  trial.title = title;
  return trial;
}

}  // namespace fault_bench
