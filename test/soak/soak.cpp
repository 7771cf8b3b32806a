#include "orders/order_soak.h"

#include <aibo_driver/Connection.h>
#include <ros/ros.h>
#include <signal.h>
#include <std_msgs/UInt32.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "orders/order_user.h"
#include "protocol/version2.h"
#include "robot_model/robot_model.h"

namespace soak {
namespace {

using std::chrono::milliseconds;
using test_support::Action;
using test_support::Conditions;
using test_support::Direction;
using test_support::FaultProxy;
using test_support::Welcome;

constexpr const char* kNamespace = "/order_soak";
constexpr int kUsers = 5;
constexpr double kMicro = 1e-6;
constexpr double kStart = 60;        // s
constexpr double kAnswers = 60;      // s; after that, a service does not answer any more
constexpr double kEnds = 30;         // s; longer than any motion, posture and trajectory
constexpr double kRecovers = 20;     // s
constexpr double kLateOrders = 1.5;  // s; what comes later has been too old for long

double now() {
  return ros::WallTime::now().toSec();
}

void passTime(int milliseconds_) {
  std::this_thread::sleep_for(milliseconds(milliseconds_));
}

std::map<std::string, std::pair<double, double>> limitsOfJoints() {
  std::map<std::string, std::pair<double, double>> limits;
  const robot_model::RobotModel* model = robot_model::findRobotModel("ERS-7");
  for (int i = 0; i < model->number_of_joints; ++i) {
    limits[model->joints[i].name] = {kMicro * model->joints[i].lowest, kMicro * model->joints[i].highest};
  }
  return limits;
}

Moving toMoving(const aibo_driver::Movement& movement) {
  return {movement.source, movement.kind, movement.name, {movement.joints.begin(), movement.joints.end()}};
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

OrderSoak::OrderSoak(const Options& options)
    : options_(options),
      random_(options.seed),
      audit_([this](const std::string& violation) { violations_.add(violation); }, limitsOfJoints()),
      proxy_(proxyOptions()),
      driver_(kNamespace, proxy_.port(), {"_stream_on_start:=false"}),
      look_at_({AIBO_LOOK_AT, std::string("__ns:=") + kNamespace}),
      handle_(kNamespace) {
  const robot_model::RobotModel* model = robot_model::findRobotModel("ERS-7");
  for (int i = 0; i < model->number_of_joints; ++i) {
    joints_[model->joints[i].identifier] = model->joints[i].name;
  }
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
  for (int i = 0; i < kUsers; ++i) {
    users_.push_back(std::make_unique<test_support::Process>(
        std::vector<std::string>{options.program, "--user", std::to_string(i), "--seed", std::to_string(random_()),
                                 std::string("__ns:=") + kNamespace, "__name:=user_" + std::to_string(i)}));
  }
}

FaultProxy::Options OrderSoak::proxyOptions() {
  FaultProxy::Options options;
  options.target_port = robot_.port();
  options.seed = options_.seed;
  options.tap = [this](std::size_t connection, Direction direction, const std::uint8_t* data, std::size_t size) {
    if (direction == Direction::kToServer) {
      hear(connection, data, size);
    }
  };
  return options;
}

// --- What happens
// -----------------------------------------------------------------------------------------------------

void OrderSoak::hear(std::size_t connection, const std::uint8_t* data, std::size_t size) {
  const double time = now();
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const test_support::Request& request : requests_[connection].feed(data, size)) {
    protocol::version2::JointTargets targets{};
    if (!request.version2 || request.kind != protocol::version2::REQUEST_JOINTS ||
        protocol::version2::decode(request.payload.data(), request.payload.size(), &targets) != nullptr) {
      continue;
    }
    for (int i = 0; i < targets.count; ++i) {
      round_.sent.push_back({time, joints_[targets.joints[i].id], kMicro * targets.joints[i].value});
    }
  }
  requests_.erase(requests_.begin(), requests_.lower_bound(connection));
}

void OrderSoak::receive(const std_msgs::String& line) {
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

void OrderSoak::receive(const sensor_msgs::JointState& joints) {
  Measured measured{joints.header.stamp.toSec()};
  for (std::size_t i = 0; i < joints.name.size(); ++i) {
    measured.positions[joints.name[i]] = joints.position[i];
  }
  measured.came = now();
  const std::lock_guard<std::mutex> lock(mutex_);
  round_.measured.push_back(measured);
}

void OrderSoak::receive(const aibo_driver::MotionState& state) {
  const double time = now();
  std::vector<Moving> moving;
  std::transform(state.movements.begin(), state.movements.end(), std::back_inserter(moving), toMoving);
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const aibo_driver::EndedMovement& ended : newOnes(ended_, state.ended)) {
    round_.ended.push_back({time, toMoving(ended.movement), ended.how, ended.reason});
  }
  ended_ = state.ended;
  moving_ = moving;
  round_.movements.push_back({time, moving});
}

// --- The course
// -------------------------------------------------------------------------------------------------------

bool OrderSoak::run() {
  const double end = now() + 60 * options_.minutes;
  try {
    begin();
    while (now() < end) {
      goThroughARound();
    }
  } catch (const std::exception& error) {
    violations_.add(error.what());
  }
  keepLogs({});
  audit_.report();
  std::printf("violations: %zu\n", violations_.count());
  return violations_.count() == 0;
}

template <typename Condition>
bool OrderSoak::waitFor(double seconds, const Condition& condition) {
  const double end = now() + seconds;
  for (;;) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (condition()) {
        return true;
      }
    }
    if (now() >= end) {
      return false;
    }
    if (!driver_.isRunning()) {
      throw std::runtime_error("the driver's node has ended:\n" + driver_.output());
    }
    passTime(20);
  }
}

void OrderSoak::begin() {
  violations_.setScene("start");
  if (!waitFor(kStart, [this] { return is_connected_ && !round_.measured.empty(); })) {
    throw std::runtime_error("the robot is not connected:\n" + driver_.output());
  }
  tellUsers(number_);
  waitForUsers(number_);
  passTime(1000);  // until all topics are connected
  takeRound();
}

void OrderSoak::tellUsers(unsigned round) {
  number_ = round;
  std_msgs::UInt32 message;
  message.data = round;
  rounds_.publish(message);
}

void OrderSoak::waitForUsers(unsigned round) {
  if (!waitFor(kAnswers, [this, round] { return quiet_users_[round] == kUsers; })) {
    std::string logs;
    for (const auto& user : users_) {
      logs += user->output();
    }
    throw std::runtime_error("a user still waits for an answer:\n" + logs);
  }
}

template <typename Service>
bool OrderSoak::succeeds(const std::string& name, Service service) {
  const bool answered = ros::service::call(handle_.resolveName(name), service);
  if (!answered || !service.response.success) {
    violations_.add(name + " between two rounds: " + (answered ? service.response.message : "not answered"));
    return false;
  }
  return true;
}

// One after the other at once: none is refused because of the one before.
void OrderSoak::getReady() {
  violations_.setScene("between rounds");
  std_srvs::SetBool motors;
  motors.request.data = 1;
  const bool is_ready =
      succeeds<std_srvs::Trigger>("release") && succeeds("motors", motors) && succeeds<std_srvs::Trigger>("stand");
  if (!is_ready) {
    passTime(1000);
  }
}

void OrderSoak::goThroughARound() {
  getReady();
  takeRound();
  violations_.setScene("round " + std::to_string(number_ / 2 + 1));
  tellUsers(number_ + 1);
  const double end = now() + uniform(6, 15);
  while (now() < end) {
    passTime(uniform(300, 2500));
    if (uniform(0, 2) > 0) {
      goWrong();
    }
  }
  tellUsers(number_ + 1);
  waitForUsers(number_);
  passTime(static_cast<int>(1000 * kLateOrders));
  if (!waitFor(kRecovers, [this] { return is_connected_; })) {
    violations_.add("the robot is not connected again");
  }
  waitForEnds();
  audit_.judge(takeRound());
}

void OrderSoak::waitForEnds() {
  waitFor(kEnds, [this] { return moving_.empty(); });  // the audit names what has not ended
  passTime(500);                                       // of joints that are measured at rest
}

void OrderSoak::goWrong() {
  Fault fault;
  fault.kind = static_cast<Fault::Kind>(uniform(0, 4));
  fault.begin = now();
  const int length = uniform(100, 2500);
  switch (fault.kind) {
    case Fault::Kind::kDriverFrozen:
      driver_.signal(SIGSTOP);
      passTime(length);
      driver_.signal(SIGCONT);
      break;
    case Fault::Kind::kRobotFrozen:
      robot_.process().signal(SIGSTOP);
      passTime(length);
      robot_.process().signal(SIGCONT);
      break;
    case Fault::Kind::kLinkCut:
      proxy_.setWelcome(uniform(0, 1) == 0 ? Welcome::kRefuse : Welcome::kSilence);
      proxy_.endConnections(uniform(0, 1) == 0 ? Action::kReset : Action::kSilence);
      passTime(length);
      proxy_.heal();
      break;
    case Fault::Kind::kLinkSlow: {
      Conditions conditions;
      conditions.delay = milliseconds(uniform(10, 200));
      conditions.jitter = milliseconds(uniform(0, 200));
      proxy_.setConditions(conditions);
      passTime(length);
      proxy_.setConditions({});
      break;
    }
    case Fault::Kind::kStickSlow:
      robot_.type("stick slow");
      passTime(3 * length);
      robot_.type("stick ready");
      break;
  }
  fault.end = now();
  const std::lock_guard<std::mutex> lock(mutex_);
  round_.faults.push_back(fault);
}

Round OrderSoak::takeRound() {
  Round round;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::swap(round, round_);
  }
  const auto by_time = [](const auto& a, const auto& b) { return a.time < b.time; };
  std::stable_sort(round.orders.begin(), round.orders.end(), by_time);
  std::stable_sort(round.measured.begin(), round.measured.end(), by_time);
  std::stable_sort(round.calls.begin(), round.calls.end(),
                   [](const Call& a, const Call& b) { return a.begin < b.begin; });
  keepLogs(round);
  return round;
}

// To look into what was judged.
void OrderSoak::keepLogs(const Round& round) {
  std::ofstream events(options_.folder + "/events.log", std::ios::app);
  events.precision(17);
  for (const Order& order : round.orders) {
    events << toText(order) << '\n';
  }
  for (const Call& call : round.calls) {
    events << toText(call) << '\n';
  }
  for (const Fault& fault : round.faults) {
    events << "fault " << static_cast<int>(fault.kind) << ' ' << fault.begin << ' ' << fault.end << '\n';
  }
  for (const Ended& end : round.ended) {
    events << "ended " << end.time << ' ' << end.movement.user << ' ' << end.movement.kind << ' ' << end.movement.name
           << ' ' << end.how << ' ' << end.reason;
    for (const std::string& joint : end.movement.joints) {
      events << ' ' << joint;
    }
    events << '\n';
  }
  for (const Movements& each : round.movements) {
    events << "movements " << each.time;
    for (const Moving& moving : each.now) {
      events << ' ' << moving.user << ' ' << moving.kind << ' ' << moving.name;
    }
    events << '\n';
  }
  std::ofstream measurements(options_.folder + "/measured.log", std::ios::app);
  measurements << std::fixed;
  for (const Measured& each : round.measured) {
    measurements << each.time << ' ' << each.came - each.time;
    for (const auto& [joint, position] : each.positions) {
      measurements << ' ' << joint << ' ' << position;
    }
    measurements << '\n';
  }
  const std::string log = driver_.output();
  std::ofstream(options_.folder + "/driver.log", std::ios::app) << log.substr(std::min(driver_log_size_, log.size()));
  driver_log_size_ = log.size();
}

}  // namespace soak
