#include "soak.h"

#include <signal.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>

namespace soak {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;
using std::chrono::system_clock;
using test_support::DiagnosticsListener;
using test_support::Direction;
using test_support::FaultProxy;
using test_support::Resources;

constexpr const char* kNamespace = "/soak";
constexpr const char* kMotion = "OPEN-R/MW/DATA/P/WAG.MTN";

// Twice the time of two attempts to connect with the longest waits (connect_timeout, reconnect_wait_max).
constexpr seconds kLongestRecovery{16};
constexpr seconds kFirstPicturePatience{60};
constexpr seconds kLongestEnd{15};

// In calm periods, one in this many pictures may be left out because this computer was busy with something else.
constexpr std::uint64_t kPicturesPerLoss = 1000;

constexpr milliseconds kStep{100};
constexpr milliseconds kLookPeriod{2000};

// Within this time, joints that were moving when the connection ended stop.
constexpr milliseconds kBraking{500};
// Damage to the answer to a heartbeat shows after 1 s, other damage earlier.
constexpr milliseconds kDamageShows{3000};
constexpr milliseconds kWatchTime{1000};
constexpr double kStill = 0.02;  // rad; for the steps of the encoders and rounding

constexpr ResourceLog::Seconds kDriverWarmUp{300};
constexpr ResourceLog::Seconds kRobotWarmUp{30};

double quantile(const std::vector<double>& sorted, double part) {
  const auto index = static_cast<std::size_t>(part * static_cast<double>(sorted.size()));
  return sorted.empty() ? 0 : sorted[std::min(index, sorted.size() - 1)];
}

void printLine(const std::string& name, unsigned tried, std::size_t violations, std::vector<double> recoveries) {
  std::sort(recoveries.begin(), recoveries.end());
  std::printf("%-34s %6u %10zu %9.0f %9.0f %9.0f\n", name.c_str(), tried, violations, 1000 * quantile(recoveries, 0.5),
              1000 * quantile(recoveries, 0.99), 1000 * quantile(recoveries, 1));
}

}  // namespace

Soak::Soak(const Options& options)
    : options_(options),
      random_(options.seed),
      pictures_(std::string(kNamespace) + "/camera/image_raw/compressed", options.folder + "/pictures", &violations_),
      robot_({"--picture-log", options.folder + "/pictures", "--memory-stick", memory_stick_.path()}),
      proxy_(proxyOptions()),
      driver_(kNamespace, proxy_.port()),
      workload_(kNamespace, memory_stick_.path(kMotion), &violations_),
      driver_resources_("driver", kDriverWarmUp),
      robot_resources_("server", kRobotWarmUp),
      table_(options.folder + "/resources.csv"),
      driver_log_(options.folder + "/driver.log") {
  table_ << "seconds,driver KB,driver descriptors,driver threads,server KB,server descriptors,server threads,"
            "pictures,faults\n";
}

FaultProxy::Options Soak::proxyOptions() {
  FaultProxy::Options options;
  options.target_port = robot_.port();
  options.seed = options_.seed;
  options.tap = [this](std::size_t connection, Direction direction, const std::uint8_t* data, std::size_t size) {
    if (direction == Direction::kToServer) {
      tap_.hear(connection, data, size);
    }
  };
  return options;
}

bool Soak::run() {
  const ResourceLog::Seconds end(60 * options_.minutes);
  try {
    awaitFirstPicture();
    while (elapsed() < end && driver_.isRunning()) {
      stayCalm();
      goWrong(mishaps_[std::uniform_int_distribution<std::size_t>(0, mishaps_.size() - 1)(random_)]);
    }
    stayCalm();
  } catch (const std::exception& error) {
    violations_.add(error.what());
  }
  violations_.setScene("the whole run");
  judgeLosses();
  endDriver();
  driver_resources_.judge(&violations_);
  robot_resources_.judge(&violations_);
  report();
  return violations_.count() == 0;
}

void Soak::awaitFirstPicture() {
  if (!pictures_.waitForPictureOf(system_clock::time_point() + seconds(1), kFirstPicturePatience)) {
    throw std::runtime_error("no picture came at all:\n" + driver_.output());
  }
  pass(kDamageShows);  // until all topics are connected
}

void Soak::stayCalm() {
  violations_.setScene("calm");
  if (!robot_.isRunning()) {
    throw std::runtime_error("the robot's server has ended:\n" + robot_.process().output());
  }
  pictures_.beginCalm();
  const auto end = elapsed() + milliseconds(std::uniform_int_distribution<int>(1000, 7000)(random_));
  while (elapsed() < end) {
    workload_.doSomething(random_);
    pass(milliseconds(std::uniform_int_distribution<int>(50, 1000)(random_)));
  }
  pictures_.endCalm();
  workload_.measure();
}

void Soak::goWrong(const Mishap& mishap) {
  violations_.setScene(mishap.name);
  ++faults_;
  ++tallies_[mishap.name].tried;
  awaitTrajectory();
  const std::size_t connections_before = tap_.connections();
  pictures_.setDamaging(mishap.damages);
  ServiceCalls calls(&workload_, random_());
  try {
    mishap.happen({&proxy_, &robot_, &workload_, [this](milliseconds time) { pass(time); }}, random_);
  } catch (const NothingCame& error) {
    violations_.add(error.what());
  }
  proxy_.heal();
  recover(mishap, system_clock::now());
  calls.end();
  expectNoJointMoves(connections_before, mishap.damages ? kDamageShows : kBraking);
  pictures_.setDamaging(false);
  workload_.callEveryService(random_);
}

// A driver that repeats commands after a reconnect would repeat these.
void Soak::awaitTrajectory() {
  const std::size_t connection = std::max<std::size_t>(tap_.connections(), 1) - 1;
  const std::size_t before = tap_.jointRequestsFrom(connection);
  workload_.moveJoints(random_);
  workload_.beginTrajectory(random_);
  const auto end = elapsed() + seconds(2);
  while (tap_.jointRequestsFrom(connection) < before + 3 && elapsed() < end) {
    pass(milliseconds(10));
  }
}

void Soak::recover(const Mishap& mishap, PictureAudit::Time healthy) {
  const auto recovery = pictures_.waitForPictureOf(healthy, kLongestRecovery);
  if (recovery) {
    tallies_[mishap.name].recoveries.push_back(recovery->count());
  } else {
    violations_.add("no picture came within " + std::to_string(kLongestRecovery.count()) + " s after the fault");
  }
}

// Nothing commands a joint meanwhile.
void Soak::expectNoJointMoves(std::size_t connections_before, milliseconds settling) {
  pass(settling);
  const auto before = workload_.measure();
  if (tap_.connections() == connections_before) {
    return;  // the trajectory goes on
  }
  pass(kWatchTime);
  if (const std::size_t requests = tap_.jointRequestsFrom(connections_before); requests > 0) {
    violations_.add("after the reconnect, " + std::to_string(requests) + " requests that move joints");
  }
  for (const auto& [joint, position] : workload_.measure()) {
    const auto was = before.find(joint);
    if (was != before.end() && std::abs(position - was->second) > kStill) {
      violations_.add("after the reconnect, " + joint + " moved by " + std::to_string(position - was->second) + " rad");
    }
  }
}

void Soak::pass(milliseconds time) {
  const auto end = steady_clock::now() + time;
  for (auto now = steady_clock::now(); now < end; now = steady_clock::now()) {
    if (now >= next_look_) {
      look();
      next_look_ = now + kLookPeriod;
    }
    std::this_thread::sleep_for(std::min<steady_clock::duration>(kStep, end - now));
  }
}

// Also called while the robot is dead; then only the driver is sampled.
void Soak::look() {
  pictures_.readLog();
  keepDriverLog();
  if (!driver_.isRunning()) {
    throw std::runtime_error("the driver's node has ended:\n" + driver_.output());
  }
  const Resources& driver = driver_resources_.sample(driver_.pid(), elapsed());
  table_ << elapsed().count() << "," << driver.resident_kilobytes << "," << driver.descriptors << "," << driver.threads;
  if (robot_.isRunning()) {
    const Resources& robot = robot_resources_.sample(robot_.process().pid(), elapsed());
    table_ << "," << robot.resident_kilobytes << "," << robot.descriptors << "," << robot.threads;
  } else {
    table_ << ",,,";
  }
  table_ << "," << pictures_.audit().count() << "," << faults_ << std::endl;
}

void Soak::keepDriverLog() {
  const std::string output = driver_.output();
  driver_log_ << output.substr(driver_log_size_) << std::flush;
  driver_log_size_ = output.size();
}

// A driver that is held up leaves out pictures that grow stale, and its diagnostics count them.
void Soak::judgeLosses() {
  const PictureAudit audit = pictures_.audit();
  if (audit.lostInCalm() == 0) {
    return;
  }
  const auto stream = diagnostics_.waitForNext(std::string(kNamespace + 1) + "/aibo_driver: stream");
  const std::string stale = DiagnosticsListener::value(stream, "pictures dropped for newer ones");
  const std::string losses = std::to_string(audit.lostInCalm()) +
                             " pictures were lost in calm periods; the driver says that it dropped " + stale +
                             " stale ones";
  const bool explained = !stale.empty() && std::stoull(stale) >= audit.lostInCalm();
  if (explained && audit.lostInCalm() * kPicturesPerLoss <= audit.calmCount()) {
    std::printf("\n%s\n", losses.c_str());
  } else {
    violations_.add(losses);
  }
}

// By SIGINT, so that a sanitizer can still report leaks, and pending service calls end.
void Soak::endDriver() {
  driver_.signal(SIGINT);
  const std::optional<int> status = driver_.waitForExit(kLongestEnd);
  if (status != EXIT_SUCCESS) {
    violations_.add(status ? "the driver's node ended with exit status " + std::to_string(*status)
                           : "the driver's node did not end");
  }
  driver_.kill();
  keepDriverLog();
}

ResourceLog::Seconds Soak::elapsed() const {
  return steady_clock::now() - begin_;
}

void Soak::report() const {
  std::vector<double> all;
  std::printf("\n%-34s %6s %10s %9s %9s %9s\n", "fault", "times", "violations", "p50 ms", "p99 ms", "worst ms");
  for (const auto& [name, tally] : tallies_) {
    printLine(name, tally.tried, violations_.countIn(name), tally.recoveries);
    all.insert(all.end(), tally.recoveries.begin(), tally.recoveries.end());
  }
  printLine("all", faults_, violations_.count(), all);
  const PictureAudit audit = pictures_.audit();
  std::printf("\n  pictures published: %llu, of these in calm periods: %llu, damaged on the way: %llu\n",
              static_cast<unsigned long long>(audit.count()), static_cast<unsigned long long>(audit.calmCount()),
              static_cast<unsigned long long>(audit.damagedCount()));
  std::printf("  services called: %zu, the longest took %lld ms\n", workload_.calls(),
              static_cast<long long>(workload_.longestCall().count()));
  driver_resources_.print();
  robot_resources_.print();
  std::printf("\n%u faults in %.1f minutes with seed %u, %zu violations, %zu of these in calm periods\n", faults_,
              elapsed().count() / 60, options_.seed, violations_.count(), violations_.countIn("calm"));
  std::fflush(stdout);
}

}  // namespace soak
