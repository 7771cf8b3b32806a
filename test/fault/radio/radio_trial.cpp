#include "radio/radio_trial.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <thread>

#include "radio/network_host.h"
#include "robot_server.h"
#include "support/safety_net.h"

namespace fault_bench {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr char kRobotAddress[] = "10.77.0.1";
constexpr char kComputerAddress[] = "10.77.0.2";

/// Records and checks what the client delivers.
class Observer {
 public:
  Observer(const RobotServer& robot, steady_clock::time_point begin) : robot_(robot), begin_(begin) {}

  void see(const aibo_client::Picture& picture) {
    const auto now = steady_clock::now();
    const auto encoded = robot_.find(picture.jpeg);
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!encoded) {
      result_.violations.insert("a picture that the robot has not taken");
      return;
    }
    if (encoded->number <= last_number_) {
      result_.violations.insert("a picture that is not newer than the one before");
    }
    last_number_ = encoded->number;
    result_.deliveries.push_back({Seconds(now - begin_).count(), Milliseconds(now - encoded->image_at).count()});
  }

  /// Whether a picture has come since then.
  bool hasSeenSince(double time) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return !result_.deliveries.empty() && result_.deliveries.back().time >= time;
  }

  /// The deliveries and violations so far.
  Result result() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return result_;
  }

 private:
  const RobotServer& robot_;
  const steady_clock::time_point begin_;
  mutable std::mutex mutex_;  // guards what follows
  std::uint64_t last_number_ = 0;
  Result result_;
};

/// The end of the last outage in s, since the beginning of the link; 0 without any.
double endOfOutages(const Trial& trial) {
  const std::vector<Outage>& outages = trial.radio.outages;
  return outages.empty() ? 0 : Seconds(outages.back().begin + outages.back().length).count();
}

}  // namespace

double quantile(const std::vector<double>& sorted, double part) {
  const auto index = static_cast<std::size_t>(part * static_cast<double>(sorted.size()));
  return sorted.empty() ? 0 : sorted[std::min(index, sorted.size() - 1)];
}

void summarize(const Trial& trial, Result& result) {
  const double back_at = endOfOutages(trial);
  const auto back = std::find_if(result.deliveries.begin(), result.deliveries.end(),
                                 [back_at](const Result::Delivery& delivery) { return delivery.time >= back_at; });
  if (back == result.deliveries.end()) {
    result.violations.insert("no picture at all, or none after the outage");
    return;
  }
  result.recovery = back_at > 0 ? 1e3 * (back->time - back_at) : -1;
  for (const Result::Delivery& delivery : result.deliveries) {
    result.ages.push_back(delivery.age);
  }
  std::sort(result.ages.begin(), result.ages.end());
  result.pictures_per_second =
      static_cast<double>(result.deliveries.size()) / (Seconds(trial.length).count() - result.deliveries.front().time);
}

Result run(const Trial& trial) {
  const NetworkHost robot_host(kRobotAddress);
  const NetworkHost computer(kComputerAddress);
  const RobotServer robot(robot_host.address(), RobotServer::kRobotPort, [&robot_host] { robot_host.enter(); });
  Result result;
  std::thread([&] {
    computer.enter();
    const RadioLink link(robot_host, computer, trial.radio);
    Observer observer(robot, link.begin());
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
      client.waitForConnection(test_support::kSafetyNet);
      rival.emplace(options, aibo_client::Callbacks());
      rival->start();
    }
    std::this_thread::sleep_until(link.begin() + trial.length);  // the rates are measured over this length
    test_support::eventually([&] { return observer.hasSeenSince(endOfOutages(trial)); });
    if (rival) {
      rival->stop();
    }
    client.stop();
    result = observer.result();
    result.connections = client.statistics().connections;
  }).join();
  summarize(trial, result);
  if (trial.has_rival && result.connections > 1) {
    result.violations.insert("another program got the place of a client that was there");
  }
  return result;
}

Trial by(aibo_client::PictureTransport transport, Trial trial) {
  trial.transport = transport;
  return trial;
}

Trial lossTrial(double bits_per_second, double loss, std::uint32_t seed, milliseconds length) {
  Trial trial;
  trial.radio.bits_per_second = bits_per_second;
  trial.radio.loss = loss;
  trial.radio.seed = seed;
  trial.length = length;
  return trial;
}

Trial outageTrial(milliseconds outage, std::uint32_t seed) {
  Trial trial = lossTrial(11e6, 0, seed, outage + milliseconds(7000));
  trial.radio.outages = {{milliseconds(2000), outage}};
  return trial;
}

}  // namespace fault_bench
