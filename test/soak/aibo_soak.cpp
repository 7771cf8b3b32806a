/// @file aibo_soak.cpp
/// Runs the driver's node and the robot's server for a long time, with random orders from five nodes and all kinds of
/// faults.

#include <aibo_driver/Connection.h>
#include <aibo_driver/MotionState.h>
#include <ros/ros.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/JointState.h>
#include <signal.h>
#include <std_msgs/String.h>
#include <std_msgs/UInt32.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <boost/program_options.hpp>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <memory>
#include <mutex>
#include <random>
#include <stdexcept>
#include <thread>

#include "order_user.h"
#include "resource_log.h"
#include "robot_model/robot_model.h"
#include "support/program.h"
#include "support/proxy/fault_proxy.h"
#include "support/ros/driver_process.h"
#include "support/safety_net.h"
#include "support/simulated_robot.h"

namespace soak {
namespace {

namespace po = boost::program_options;

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

Targets positionsIn(const sensor_msgs::JointState& joints) {
  Targets positions;
  for (std::size_t i = 0; i < joints.name.size(); ++i) {
    positions[joints.name[i]] = joints.position[i];
  }
  return positions;
}

std::string nameOf(int joint) {
  const robot_model::RobotModel* const model = robot_model::findRobotModel("ERS-7");
  return model->joints[robot_model::findJointByIdentifier(*model, joint)].name;
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

struct Options {
  double minutes = 60;
  unsigned seed = 1;
  std::string folder;   ///< existing folder for logs
  std::string program;  ///< this one, which is started again as each of the users
};

/// Driver, simulated robot, a proxy between them, and five nodes that give random orders of all kinds, while links are
/// cut, processes stall and the memory stick is slow. In rounds: some seconds of orders, then silence until all
/// has ended. Then the round is judged. Needs a running ROS master and a spinner.
class Soak {
 public:
  explicit Soak(const Options& options);

  /// @return true if there was no violation
  bool run();

 private:
  void hear(const test_support::Bytes& accepted_joints);
  template <typename Message>
  void subscribe(const std::string& topic, const std::function<void(const Message&)>& take);
  void receive(const Call& call);
  void receive(const aibo_driver::MotionState& state);

  void begin();
  void getReady();
  void goThroughARound();
  void goWrong();
  void tellUsers(unsigned round);
  void waitForUsers(unsigned round);
  Round takeRound();
  void end();
  void complain(const std::string& violation);
  void print(const std::string& violation);
  template <typename Service>
  void expectSuccess(const std::string& name, Service service = Service());
  template <typename Condition>
  bool waitFor(double seconds, const Condition& condition);
  void pass(int length);
  int uniform(int lowest, int highest) { return std::uniform_int_distribution<int>(lowest, highest)(random_); }

  const Options options_;
  std::mt19937 random_;
  OrderAudit audit_;
  ResourceLog driver_resources_;
  ResourceLog robot_resources_;
  const double begin_;

  std::mutex mutex_;  // guards what follows, down to the test's processes
  std::size_t violations_ = 0;
  std::string scene_ = "start";
  Round round_;
  std::uint64_t pictures_ = 0;                     ///< that the driver has published
  std::vector<aibo_driver::EndedMovement> ended_;  ///< as the newest motion_state has them
  std::vector<Moving> moving_;                     ///< the same
  std::map<unsigned, int> quiet_users_;            ///< how many, by round
  bool is_connected_ = false;

  test_support::SimulatedRobot robot_;
  FaultProxy proxy_;
  test_support::DriverProcess driver_;
  std::vector<std::unique_ptr<test_support::Process>> users_;

  ros::NodeHandle handle_;
  unsigned number_ = 1;  ///< of the round; users give orders in even ones
  double next_sample_ = 0;
  ros::Publisher rounds_;
  std::vector<ros::Subscriber> subscribers_;  // last: their callbacks use all of the above
};

Soak::Soak(const Options& options)
    : options_(options),
      random_(options.seed),
      audit_([this](const std::string& violation) { complain(violation); }),
      driver_resources_(options.folder + "/driver.csv"),
      robot_resources_(options.folder + "/robot.csv"),
      begin_(now()),
      proxy_(robot_.port(),
             [this](Direction direction, const test_support::Message& message) {
               if (direction == Direction::kToClient && message.kind == 'j') {
                 hear(message.payload);
               }
             }),
      driver_(kNamespace, proxy_.port(), {test_support::kByTcp}),
      handle_(kNamespace) {
  constexpr bool kLatched = true;
  rounds_ = handle_.advertise<std_msgs::UInt32>(kUserRuns, 10, kLatched);
  subscribe<std_msgs::String>(kUserCalls, [this](const auto& call) { receive(parseCall(call.data)); });
  subscribe<sensor_msgs::JointState>(kUserOrders, [this](const auto& order) {
    round_.orders.push_back({order.header.frame_id, order.header.stamp.toSec(), positionsIn(order)});
  });
  subscribe<sensor_msgs::JointState>("joint_states", [this](const auto& joints) {
    round_.measured.push_back({joints.header.stamp.toSec(), positionsIn(joints)});
  });
  subscribe<aibo_driver::MotionState>("motion_state", [this](const auto& state) { receive(state); });
  subscribe<aibo_driver::Connection>("connection", [this](const auto& connection) {
    is_connected_ = connection.state == aibo_driver::Connection::CONNECTED;
  });
  subscribe<sensor_msgs::CompressedImage>("camera/image_raw/compressed", [this](const auto&) { ++pictures_; });
  for (int i = 0; i < kUsers; ++i) {
    users_.push_back(std::make_unique<test_support::Process>(
        std::vector<std::string>{options.program, "--user", std::to_string(i), "--seed", std::to_string(random_()),
                                 std::string("__ns:=") + kNamespace, "__name:=user_" + std::to_string(i)}));
  }
}

void Soak::hear(const test_support::Bytes& accepted_joints) {
  protocol::version2::JointTargets accepted{};
  protocol::version2::decode(accepted_joints.data(), accepted_joints.size(), &accepted);
  const double time = now();
  const std::lock_guard<std::mutex> lock(mutex_);
  for (int i = 0; i < accepted.count; ++i) {
    round_.accepted.push_back({time, nameOf(accepted.joints[i].id), 1e-6 * accepted.joints[i].value});
  }
}

/// Has messages taken while the mutex is held.
template <typename Message>
void Soak::subscribe(const std::string& topic, const std::function<void(const Message&)>& take) {
  constexpr std::uint32_t kAllOfThem = 10000;
  subscribers_.push_back(handle_.subscribe<Message>(topic, kAllOfThem, [this, take](const auto& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    take(*message);
  }));
}

void Soak::receive(const Call& call) {
  if (call.service == kQuiet) {
    ++quiet_users_[static_cast<unsigned>(std::stoul(call.message))];
  } else {
    round_.calls.push_back(call);
  }
}

void Soak::receive(const aibo_driver::MotionState& state) {
  for (const aibo_driver::EndedMovement& ended : newOnes(ended_, state.ended)) {
    round_.ended.push_back(toMoving(ended.movement));
  }
  ended_ = state.ended;
  moving_.clear();
  for (const aibo_driver::Movement& movement : state.movements) {
    moving_.push_back(toMoving(movement));
    round_.begun[movement.order] = moving_.back();
  }
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
  if (audit_.stops() == 0 || audit_.commands() == 0) {
    complain("no stop or no accepted command was judged: was the time too short, or the computer too busy?");
  }
  std::printf("\n%u rounds, %llu pictures, %zu stops and %zu accepted commands judged, %zu violations\n", number_ / 2,
              static_cast<unsigned long long>(pictures_), audit_.stops(), audit_.commands(), violations_);
}

/// Lets this many milliseconds pass, and takes samples of resources meanwhile.
void Soak::pass(int length) {
  const double end = now() + 0.001 * length;
  do {
    if (!driver_.isRunning() || !robot_.isRunning()) {
      throw std::runtime_error("driver or robot has ended:\n" + driver_.output() + robot_.process().output());
    }
    if (now() > next_sample_) {
      driver_resources_.sample(driver_.pid(), now() - begin_);
      robot_resources_.sample(robot_.process().pid(), now() - begin_);
      next_sample_ = now() + 2;
    }
    std::this_thread::sleep_for(milliseconds(20));
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
    round.moving = moving_;
  }
  const auto by_time = [](const auto& a, const auto& b) { return a.time < b.time; };
  std::stable_sort(round.orders.begin(), round.orders.end(), by_time);
  std::stable_sort(round.measured.begin(), round.measured.end(), by_time);
  std::stable_sort(round.calls.begin(), round.calls.end(),
                   [](const Call& a, const Call& b) { return a.begin < b.begin; });
  return round;
}

constexpr int kNoUser = -1;

int run(const Options& options, int user) {
  if (user != kNoUser) {
    runUser(ros::this_node::getNamespace(), static_cast<unsigned>(user), options.seed);
    return EXIT_SUCCESS;
  }
  if (!(options.minutes > 0)) {
    throw po::error("option '--minutes' must be above 0");
  }
  std::printf("%g minutes with seed %u\n", options.minutes, options.seed);
  std::fflush(stdout);
  const ros::NodeHandle handle;
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return Soak(options).run() ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace soak

int main(int argc, char** argv) {
  namespace po = boost::program_options;
  ::signal(SIGPIPE, SIG_IGN);
  // Ctrl-C ends this program and all that it has started at once.
  ros::init(argc, argv, "aibo_soak", ros::init_options::NoSigintHandler);
  soak::Options options;
  int user = soak::kNoUser;
  options.program = argv[0];
  po::options_description description("Options", 110);
  // clang-format off
  description.add_options()
    ("minutes", po::value(&options.minutes)->default_value(60), "how long")
    ("seed", po::value(&options.seed)->default_value(std::random_device()(), "random"), "seed of all random choices")
    ("folder", po::value(&options.folder)->default_value("."), "existing folder for logs")
    ("user", po::value(&user)->default_value(soak::kNoUser, "none"),
     "be one of the nodes that give orders, 0 to 4; the program starts them itself");
  // clang-format on
  return test_support::runProgram(
      argc, argv,
      "Runs driver and simulated robot for a long time, with random orders and all kinds of faults.\n"
      "Needs a ROS master of its own, which scripts/soak starts.",
      description, [&] { return soak::run(options, user); });
}
