// Stop between the mover, the client library and a running server.
// AIBO_RACES is the number of races, to run for hours.
#include <gmock/gmock.h>

#include <atomic>
#include <condition_variable>
#include <cstdlib>
#include <future>
#include <mutex>
#include <optional>
#include <random>
#include <thread>

#include "aibo_client/rcserver_client.h"
#include "movement/mover.h"
#include "support/safety_net.h"
#include "support/simulated_robot.h"

namespace aibo_driver::movement {
namespace {

using aibo_client::Posture;
using aibo_client::WalkVelocity;
using std::chrono::milliseconds;
using test_support::eventually;
using namespace std::chrono_literals;

constexpr double kStill = 0.02;  // rad; for the steps of encoders
constexpr double kFastest = 20;  // rad/s; faster than the joints
constexpr auto kSlow = 2000ms;   // of a memory stick
constexpr auto kStops = 300ms;   // after the answer to a stop (docs/faults.md, "Soak test")
constexpr auto kFrame = 8ms;     // of OPEN-R

SteadyTime now() {
  return std::chrono::steady_clock::now();
}

/// A robot, and the part of a driver that moves it.
class MovedRobot {
 public:
  explicit MovedRobot(const std::vector<std::string>& options = {}) : robot_(options) {
    Mover::Listener listener;
    listener.on_ended = [this](const EndedMovement& ended) {
      const std::lock_guard<std::mutex> lock(mutex_);
      ++ends_[ended.movement.order];
      stopped_ += ended.how == aibo_client::EndedHow::kStopped ? 1 : 0;
    };
    mover_.setListener(listener);
    client_.setTelemetryPeriod(4);
    client_.start();
    EXPECT_TRUE(eventually([this] { return client_.statistics().telemetry > 0; }));
  }

  ~MovedRobot() {
    is_over_ = true;
    client_.stop();
    ticker_.wait();
  }

  Mover& mover() { return mover_; }
  Order order(const std::string& node = "/user") const { return {node, now()}; }

  /// Lets a time of the robot pass, however fast this computer is. It begins kStops after the next measurement. Returns
  /// the joints that move in it, and how far.
  std::string movedWithin(milliseconds time) {
    std::unique_lock<std::mutex> lock(mutex_);
    ranges_.clear();
    begin_.reset();
    const auto is_over = [&] { return begin_ && newest_ - *begin_ >= (kStops + time) / kFrame; };
    std::string moved = measured_more_.wait_for(lock, test_support::kSafetyNet, is_over) ? "" : "nothing was measured";
    for (const auto& [joint, range] : ranges_) {
      const double way = range.second - range.first;
      moved += way > kStill ? " " + std::to_string(joint) + ": " + std::to_string(way) : "";
    }
    return moved;
  }

  /// How many movements a stop has ended.
  int stopped() const { return stopped_; }

  /// The movements that have not ended just once.
  std::string wronglyEnded() {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::string wrong;
    for (const auto& [movement, ends] : ends_) {
      wrong += ends == 1 ? "" : " " + std::to_string(movement);
    }
    return wrong;
  }

  MovementId goal = 0;

 private:
  aibo_client::ClientOptions options() const {
    aibo_client::ClientOptions options;
    options.port = robot_.port();
    options.read_timeout = 20s;
    options.guard_walks = false;
    return options;
  }

  aibo_client::Callbacks callbacks() {
    aibo_client::Callbacks callbacks;
    callbacks.on_status = [this](const aibo_client::ConnectionStatus& status) {
      status.state == aibo_client::ConnectionState::kConnected ? mover_.connected() : mover_.disconnected();
    };
    callbacks.on_telemetry = [this](const aibo_client::Telemetry& telemetry) {
      measured_.update(telemetry);
      const std::lock_guard<std::mutex> lock(mutex_);
      newest_ = telemetry.frame_number.value_or(0);
      begin_ = begin_.value_or(newest_);
      measured_more_.notify_all();
      for (const aibo_client::JointReading& joint : telemetry.joints) {
        if (newest_ - *begin_ < kStops / kFrame) {
          break;
        }
        auto& [least, most] = ranges_.try_emplace(joint.id, joint.position, joint.position).first->second;
        least = std::min(least, joint.position);
        most = std::max(most, joint.position);
      }
    };
    callbacks.on_steered = [this](const WalkVelocity& velocity, std::uint64_t order, std::uint64_t walk) {
      mover_.steered(velocity, order, walk);
    };
    callbacks.on_ended = [this](const aibo_client::ActivityEnd& end) { mover_.ended(end); };
    callbacks.on_refused = [this](const aibo_client::Refusal& refusal) { mover_.refused(refusal); };
    callbacks.on_motors_and_posture = [this](const aibo_client::MotorsAndPosture& state) {
      mover_.robotChanged(state);
    };
    return callbacks;
  }

  test_support::SimulatedRobot robot_;
  JointTable table_{"ERS-7", kFastest};
  MeasuredJoints measured_{table_};
  std::mutex mutex_;
  std::condition_variable measured_more_;
  std::int64_t newest_ = 0;                          ///< frame of the newest measurement
  std::optional<std::int64_t> begin_;                ///< of the time that movedWithin() watches
  std::map<int, std::pair<double, double>> ranges_;  ///< of the joints' positions
  std::map<MovementId, int> ends_;
  std::atomic<int> stopped_{0};
  aibo_client::RcServerClient client_{options(), callbacks()};
  Mover mover_{table_, measured_, client_, kFastest};
  std::atomic<bool> is_over_{false};
  std::future<void> ticker_ = std::async(std::launch::async, [this] {
    for (; !is_over_; std::this_thread::sleep_for(JointPlan::kPeriod)) {
      mover_.advance();
    }
  });
};

const std::string kSlowMotion = "motion, slow stick";
const std::string kKinds[] = {"command",  kSlowMotion, "trajectory", "motion", "sit",
                              "velocity", "rest",      "stand",      "goal"};

// Called with 0, 1, 2 and so on. Rest is possible also while the robot is stopped, if it is called after the stop.
void give(MovedRobot& robot, const std::string& kind, const Order& first, int i) {
  Mover& mover = robot.mover();
  const Order order = robot.order();
  if (kind == "command") {
    const double side = i / 20 % 2;
    mover.command(order, {"head_pan", "left_front_knee"}, {side - 0.5, side + 1}, {});
  } else if (kind == "velocity") {
    mover.steer(order, i == 0 ? WalkVelocity{} : WalkVelocity{0.1, 0, 0});
  } else if (kind == "goal") {
    robot.goal = i == 0 ? mover.walkToGoal(order, "ahead").id : robot.goal;
    mover.steerToGoal(robot.goal, {0.1, 0, 0});
  } else if (i == 0 && kind == "trajectory") {
    mover.follow(order, {{"head_pan"}, {{0.5, {0.5}, {}}, {1.0, {-0.5}, {}}}}, 0ms);
  } else if (i == 0 && (kind == "motion" || kind == kSlowMotion)) {
    mover.play(order, "NOD.MTN", 5);
  } else if (i == 0) {
    mover.takePosture(first, kind == "sit" ? Posture::kSit : kind == "rest" ? Posture::kRest : Posture::kStand);
  }
}

class StopTest : public ::testing::Test {
 protected:
  // A stop comes before or after the order, often near one of the moments at which something happens to it.
  milliseconds leadOf(const std::string& kind) {
    const int most[] = {5, 50, 700};
    const milliseconds lead{draw(-2, most[draw(0, 2)])};
    return kind == kSlowMotion && draw(0, 1) == 1 ? kSlow + milliseconds(draw(-50, 100)) : lead;
  }

  void race(const std::string& kind) {
    MovedRobot& robot = kind == kSlowMotion ? slow_ : quick_;
    robot.mover().setMotors(robot.order(), true);
    const milliseconds lead = leadOf(kind);
    SCOPED_TRACE(kind + ", " + std::to_string(lead.count()) + " ms");
    std::atomic<bool> is_over{false};
    const SteadyTime stop = now() + std::max(lead, 0ms) + 1ms;
    const auto giver = std::async(std::launch::async, [&] {
      std::this_thread::sleep_until(stop - lead);
      for (int i = 0; i == 0 || !is_over; ++i) {
        give(robot, kind, {"/user", std::min(stop - lead, stop)}, i);
        std::this_thread::sleep_for(20ms);
      }
    });
    std::this_thread::sleep_until(stop);
    EXPECT_NO_THROW(robot.mover().stop(robot.order("/panel")));
    const auto left = robot.mover().state().movements;
    EXPECT_TRUE(left.empty()) << left[0].name << " goes on";
    EXPECT_EQ(robot.movedWithin(kind == kSlowMotion ? kSlow + 300ms : 350ms), "");
    is_over = true;
    giver.wait();
    EXPECT_TRUE(robot.mover().state().movements.empty());
    EXPECT_EQ(robot.wronglyEnded(), "");
    robot.mover().release(robot.order("/panel"));
  }

  int draw(int least, int most) { return std::uniform_int_distribution<int>(least, most)(random_); }

  std::mt19937 random_{std::random_device()()};
  MovedRobot quick_;
  MovedRobot slow_{{"--stick-time", std::to_string(kSlow.count())}};
};

TEST_F(StopTest, WinsEachRaceAgainstEveryKindOfOrder) {
  const char* const many = std::getenv("AIBO_RACES");
  const std::size_t races = many == nullptr ? std::size(kKinds) : std::strtoul(many, nullptr, 10);
  for (std::size_t i = 0; i < races; ++i) {
    race(kKinds[i % std::size(kKinds)]);
  }
  EXPECT_GT(quick_.stopped(), 0);
}

}  // namespace
}  // namespace aibo_driver::movement
