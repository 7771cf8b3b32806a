#include "soak.h"

#include <aibo_driver/Connection.h>
#include <ros/ros.h>
#include <sensor_msgs/CompressedImage.h>
#include <signal.h>
#include <std_msgs/UInt32.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "order_user.h"
#include "support/safety_net.h"

namespace soak {
namespace {

using std::chrono::milliseconds;
using test_support::Action;
using test_support::Conditions;
using test_support::Direction;
using test_support::FaultProxy;
using test_support::Welcome;

constexpr const char* kNamespace = "/soak";
constexpr int kUsers = 5;
constexpr double kStart = 60;        // s
constexpr double kAnswers = 60;      // s; after that, a service does not answer any more
constexpr double kEnds = 30;         // s; longer than any motion, posture and trajectory
constexpr double kRecovers = 20;     // s
constexpr double kLateOrders = 1.5;  // s; what comes later has been too old for long

double now() {
  return ros::WallTime::now().toSec();
}

Moving toMoving(const aibo_driver::Movement& movement) {
  return {movement.order, movement.source, movement.kind, movement.name};
}

/// Those that have ended between two messages, each of which has the latest, the newest last.
std::vector<aibo_driver::EndedMovement> newOnes(const std::vector<aibo_driver::EndedMovement>& before,
                                                const std::vector<aibo_driver::EndedMovement>& now) {
  for (auto first = before.begin(); first != before.end(); ++first) {
    const auto kept = before.end() - first;
    if (kept <= static_cast<std::ptrdiff_t>(now.size()) && std::equal(first, before.end(), now.begin())) {
      return {now.begin() + kept, now.end()};
    }
  }
  return now;
}

}  // namespace

Soak::Soak(const Options& options)
    : options_(options),
      random_(options.seed),
      audit_([this](const std::string& violation) { complain(violation); }),
      driver_resources_(options.folder + "/driver.csv"),
      robot_resources_(options.folder + "/robot.csv"),
      begin_(now()),
      wire_([this](const std::string& violation) { print(violation); }),  // the mutex is held
      proxy_(proxyOptions()),
      driver_(kNamespace, proxy_.port(), {test_support::kByTcp}),
      handle_(kNamespace) {
  constexpr std::uint32_t kAllOfThem = 10000;
  constexpr bool kLatched = true;
  rounds_ = handle_.advertise<std_msgs::UInt32>(kUserRuns, 10, kLatched);
  subscribers_.push_back(handle_.subscribe<std_msgs::String>(
      kUserLog, kAllOfThem, [this](const std_msgs::String::ConstPtr& line) { receive(*line); }));
  subscribers_.push_back(handle_.subscribe<sensor_msgs::JointState>(
      "joint_states", kAllOfThem, [this](const sensor_msgs::JointState::ConstPtr& joints) { receive(*joints); }));
  subscribers_.push_back(handle_.subscribe<aibo_driver::MotionState>(
      "motion_state", kAllOfThem, [this](const aibo_driver::MotionState::ConstPtr& state) { receive(*state); }));
  subscribers_.push_back(handle_.subscribe<aibo_driver::Connection>(
      "connection", kAllOfThem, [this](const aibo_driver::Connection::ConstPtr& connection) {
        const std::lock_guard<std::mutex> lock(mutex_);
        is_connected_ = connection->state == aibo_driver::Connection::CONNECTED;
      }));
  subscribers_.push_back(handle_.subscribe<sensor_msgs::CompressedImage>(
      "camera/image_raw/compressed", kAllOfThem, [this](const sensor_msgs::CompressedImage::ConstPtr&) {
        const std::lock_guard<std::mutex> lock(mutex_);
        ++pictures_;
      }));
  for (int i = 0; i < kUsers; ++i) {
    users_.push_back(std::make_unique<test_support::Process>(
        std::vector<std::string>{options.program, "--user", std::to_string(i), "--seed", std::to_string(random_()),
                                 std::string("__ns:=") + kNamespace, "__name:=user_" + std::to_string(i)}));
  }
}

FaultProxy::Options Soak::proxyOptions() {
  FaultProxy::Options options;
  options.target_port = robot_.port();
  options.tap = [this](std::size_t connection, Direction direction, const std::uint8_t* data, std::size_t size) {
    if (direction == Direction::kToClient) {
      const std::lock_guard<std::mutex> lock(mutex_);
      wire_.hear(connection, data, size, now());
    }
  };
  return options;
}

void Soak::receive(const std_msgs::String& line) {
  const UserLine parsed = parseUserLine(line.data);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (parsed.order) {
    round_.orders.push_back(*parsed.order);
  } else if (parsed.call) {
    round_.calls.push_back(*parsed.call);
  } else {
    ++quiet_users_[*parsed.quiet_in];
  }
}

void Soak::receive(const sensor_msgs::JointState& joints) {
  Measured measured{joints.header.stamp.toSec()};
  for (std::size_t i = 0; i < joints.name.size(); ++i) {
    measured.positions[joints.name[i]] = joints.position[i];
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  round_.measured.push_back(measured);
}

void Soak::receive(const aibo_driver::MotionState& state) {
  std::vector<Moving> moving;
  std::transform(state.movements.begin(), state.movements.end(), std::back_inserter(moving), toMoving);
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const aibo_driver::EndedMovement& ended : newOnes(ended_, state.ended)) {
    round_.ended.push_back(toMoving(ended.movement));
  }
  for (const Moving& movement : moving) {
    round_.begun[movement.order] = movement;
  }
  ended_ = state.ended;
  moving_ = moving;
}

void Soak::complain(const std::string& violation) {
  const std::lock_guard<std::mutex> lock(mutex_);
  print(violation);
}

void Soak::print(const std::string& violation) {
  ++violations_;
  std::printf("VIOLATION (%s): %s\n", scene_.c_str(), violation.c_str());
  std::fflush(stdout);
}

bool Soak::run() {
  try {
    begin();
    while (now() < begin_ + 60 * options_.minutes) {
      goThroughARound();
    }
  } catch (const std::exception& error) {
    complain(error.what());
  }
  end();
  return violations_ == 0;
}

void Soak::begin() {
  if (!waitFor(kStart, [this] { return is_connected_ && !round_.measured.empty() && pictures_ > 0; })) {
    throw std::runtime_error("the robot is not connected:\n" + driver_.output());
  }
  tellUsers(number_);
  waitForUsers(number_);
  pass(1000);  // until all topics are connected
}

void Soak::end() {
  driver_.signal(SIGINT);  // so that a sanitizer can still report leaks
  if (driver_.waitForExit(test_support::kSafetyNet) != EXIT_SUCCESS) {
    complain("the driver's node has not ended well");
  }
  std::ofstream(options_.folder + "/driver.log") << driver_.output();
  if (const std::string growth = driver_resources_.growth(); !growth.empty()) {
    complain("driver: " + growth);
  }
  if (const std::string growth = robot_resources_.growth(); !growth.empty()) {
    complain("server: " + growth);
  }
  audit_.report();
  wire_.report();
  std::printf("pictures: %llu\nviolations: %zu\n", static_cast<unsigned long long>(pictures_), violations_);
}

/// Lets this much time pass, and takes samples of resources meanwhile.
void Soak::pass(int milliseconds) {
  const double end = now() + 0.001 * milliseconds;
  do {
    if (!driver_.isRunning() || !robot_.isRunning()) {
      throw std::runtime_error("driver or robot has ended:\n" + driver_.output() + robot_.process().output());
    }
    if (now() > next_sample_) {
      driver_resources_.sample(driver_.pid(), now() - begin_);
      robot_resources_.sample(robot_.process().pid(), now() - begin_);
      next_sample_ = now() + 2;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  } while (now() < end);
}

template <typename Condition>
bool Soak::waitFor(double seconds, const Condition& condition) {
  const auto is_true = [&] {
    const std::lock_guard<std::mutex> lock(mutex_);
    return condition();
  };
  for (const double end = now() + seconds; !is_true() && now() < end;) {
    pass(20);
  }
  return is_true();
}

void Soak::tellUsers(unsigned round) {
  number_ = round;
  std_msgs::UInt32 message;
  message.data = round;
  rounds_.publish(message);
}

void Soak::waitForUsers(unsigned round) {
  if (!waitFor(kAnswers, [this, round] { return quiet_users_[round] == kUsers; })) {
    throw std::runtime_error("a user still waits for an answer");
  }
}

template <typename Service>
void Soak::expectSuccess(const std::string& name, Service service) {
  const bool answered = ros::service::call(handle_.resolveName(name), service);
  if (!answered || !service.response.success) {
    complain(name + " between two rounds: " + (answered ? service.response.message : "not answered"));
  }
}

// They are called immediately after each other, and none is refused because of the previous one.
void Soak::getReady() {
  std_srvs::SetBool motors;
  motors.request.data = 1;
  expectSuccess<std_srvs::Trigger>("release");
  expectSuccess("motors", motors);
  expectSuccess<std_srvs::Trigger>("stand");
}

void Soak::goThroughARound() {
  getReady();
  takeRound();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    scene_ = "round " + std::to_string(number_ / 2 + 1);
  }
  tellUsers(number_ + 1);
  const double end = now() + uniform(6, 15);
  while (now() < end) {
    pass(uniform(300, 2500));
    if (uniform(0, 2) > 0) {
      goWrong();
    }
  }
  tellUsers(number_ + 1);
  waitForUsers(number_);
  pass(static_cast<int>(1000 * kLateOrders));
  std::uint64_t before = 0;
  const auto is_connected = [&] {
    before = pictures_;
    return is_connected_;
  };
  if (!waitFor(kRecovers, is_connected) || !waitFor(kRecovers, [&] { return pictures_ > before + 10; })) {
    complain("the robot is not connected again, or no pictures come");
  }
  waitFor(kEnds, [this] { return moving_.empty(); });  // the audit names what has not ended
  pass(3000);                                          // of joints that are measured at rest
  const std::size_t violations = violations_;
  const Round round = takeRound();
  audit_.judge(round);
  for (const std::string& fault : violations_ > violations ? round.faults : std::vector<std::string>()) {
    std::printf("  %s\n", fault.c_str());
  }
}

void Soak::goWrong() {
  enum { kDriverFrozen, kRobotFrozen, kLinkCut, kLinkSlow, kStickSlow };
  static const char* const kNames[] = {"driver frozen", "robot frozen", "link cut", "link slow", "stick slow"};
  const double begin = now();
  const int length = uniform(100, 2500);
  const int what = uniform(kDriverFrozen, kStickSlow);
  switch (what) {
    case kDriverFrozen:
      driver_.signal(SIGSTOP);
      pass(length);
      driver_.signal(SIGCONT);
      break;
    case kRobotFrozen:
      robot_.process().signal(SIGSTOP);
      pass(length);
      robot_.process().signal(SIGCONT);
      break;
    case kLinkCut:
      proxy_.setWelcome(uniform(0, 1) == 0 ? Welcome::kRefuse : Welcome::kSilence);
      proxy_.endConnections(uniform(0, 1) == 0 ? Action::kReset : Action::kSilence);
      pass(length);
      proxy_.heal();
      break;
    case kLinkSlow: {
      Conditions conditions;
      conditions.delay = milliseconds(uniform(10, 200));
      conditions.jitter = milliseconds(uniform(0, 200));
      proxy_.setConditions(conditions);
      pass(length);
      proxy_.setConditions({});
      break;
    }
    case kStickSlow:
      robot_.type("stick slow");
      pass(3 * length);
      robot_.type("stick ready");
      break;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  round_.faults.push_back(std::string(kNames[what]) + " " + hourClock(begin) + " to " + hourClock(now()));
}

Round Soak::takeRound() {
  Round round;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::swap(round, round_);
    round.accepted = wire_.takeAccepted();
    round.moving = moving_;
  }
  const auto by_time = [](const auto& a, const auto& b) { return a.time < b.time; };
  std::stable_sort(round.orders.begin(), round.orders.end(), by_time);
  std::stable_sort(round.measured.begin(), round.measured.end(), by_time);
  std::stable_sort(round.calls.begin(), round.calls.end(),
                   [](const Call& a, const Call& b) { return a.begin < b.begin; });
  return round;
}

}  // namespace soak
