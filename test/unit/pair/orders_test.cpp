// Orders and the reports of their ends, between the client library and a running server.
#include <gmock/gmock.h>

#include <condition_variable>
#include <csignal>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "aibo_client/rcserver_client.h"
#include "support/safety_net.h"
#include "support/simulated_robot.h"

using namespace aibo_client;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test_support::kSafetyNet;
using test_support::SimulatedRobot;
using testing::ElementsAre;

namespace {

constexpr int kHeadPan = 2;

/// A client, and its reports.
class User {
 public:
  explicit User(const SimulatedRobot& robot, milliseconds read_timeout = seconds(10))
      : client_(options(robot.port(), read_timeout), callbacks()) {}
  ~User() { client_.stop(); }

  RcServerClient& client() { return client_; }

  void connect() {
    client_.setTelemetryPeriod(4);
    client_.start();
    ASSERT_TRUE(await([this] { return was_connected_ && positions_.count(kHeadPan) > 0; }));
  }

  /// @return false if the condition does not become true in a generous time
  template <typename Condition>
  bool await(const Condition& condition) {
    std::unique_lock<std::mutex> lock(mutex_);
    return changed_.wait_for(lock, kSafetyNet, condition);
  }

  double pan() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return positions_[kHeadPan];
  }

  // What the callbacks have got, under the lock of await().
  bool was_connected_ = false;
  std::string reason_;
  std::map<int, double> positions_;
  std::vector<Refusal> refusals_;
  std::vector<ActivityEnd> walks_;  ///< ends of walks

 private:
  static ClientOptions options(int port, milliseconds read_timeout) {
    ClientOptions options;
    options.port = port;
    options.read_timeout = read_timeout;
    return options;
  }

  template <typename Change>
  void change(const Change& change) {
    const std::lock_guard<std::mutex> lock(mutex_);
    change();
    changed_.notify_all();
  }

  Callbacks callbacks() {
    Callbacks callbacks;
    callbacks.on_status = [this](const ConnectionStatus& status) {
      change([&] {
        was_connected_ = was_connected_ || status.state == ConnectionState::kConnected;
        reason_ = status.reason.empty() ? reason_ : status.reason;
      });
    };
    callbacks.on_telemetry = [this](const Telemetry& telemetry) {
      change([&] {
        for (const JointReading& joint : telemetry.joints) {
          positions_[joint.id] = joint.position;
        }
      });
    };
    callbacks.on_refused = [this](const Refusal& refusal) { change([&] { refusals_.push_back(refusal); }); };
    callbacks.on_ended = [this](const ActivityEnd& end) {
      if (end.kind == EndedKind::kWalk) {
        change([&] { walks_.push_back(end); });
      }
    };
    return callbacks;
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  RcServerClient client_;
};

/// With a server of version 1 or 2.
class PairTest : public testing::TestWithParam<std::string> {
 protected:
  SimulatedRobot robot_{{"--protocol-version", GetParam()}};
};

INSTANTIATE_TEST_SUITE_P(Versions, PairTest, testing::Values("1", "2"));

TEST_P(PairTest, AServerThatIsFrozenIsNotConnectedToUntilItAnswers) {
  robot_.process().signal(SIGSTOP);
  User user(robot_, milliseconds(300));
  user.client().start();
  EXPECT_TRUE(user.await([&] { return user.reason_.find("sent nothing") != std::string::npos; }))
      << "it has not closed anything";
  EXPECT_FALSE(user.was_connected_);
  EXPECT_THROW(user.client().commandJoints({{kHeadPan, 0.1}}, milliseconds(0)), NetworkException);
  robot_.process().signal(SIGCONT);
  EXPECT_TRUE(user.await([&] { return user.was_connected_; }));
}

// Like a process under a debugger, or a computer that was asleep.
TEST_P(PairTest, WhatWaitedForAFrozenServerIsRefusedAndWhatComesAfterItIsNot) {
  User user(robot_);
  user.connect();
  const double before = user.pan();
  robot_.process().signal(SIGSTOP);
  user.client().commandJoints({{kHeadPan, before + 0.5}}, milliseconds(0));
  std::this_thread::sleep_for(milliseconds(900));  // this wait is what is tested
  robot_.process().signal(SIGCONT);
  ASSERT_TRUE(user.await([&] { return !user.refusals_.empty(); }));
  EXPECT_THAT(user.refusals_[0].ids, ElementsAre(kHeadPan));
  std::this_thread::sleep_for(milliseconds(300));  // as is this one: the head could move meanwhile
  EXPECT_NEAR(user.pan(), before, 0.02);
  user.client().commandJoints({{kHeadPan, before + 0.5}}, milliseconds(0));
  EXPECT_TRUE(user.await([&] { return user.positions_[kHeadPan] > before + 0.4; }));
}

// Each attempt makes the robot ask the client for a sign.
TEST(PairOfVersion2Test, ASecondProgramDoesNotTakeThePlaceOfAClientThatLives) {
  SimulatedRobot robot;
  User user(robot);
  user.connect();
  User other(robot);
  other.client().start();
  EXPECT_TRUE(other.await([&] { return !other.reason_.empty(); })) << "it is turned away";
  EXPECT_FALSE(other.was_connected_);
  EXPECT_EQ(user.reason_, "");
  user.client().commandJoints({{kHeadPan, 0.4}}, milliseconds(0));
  EXPECT_TRUE(user.await([&] { return user.positions_[kHeadPan] > 0.3; }));
}

// Steps of a trajectory wait for answers. A velocity does not, and would go before them.
TEST(PairOfVersion2Test, AWalkIsNotEndedByAnEarlierCommandToTheLegs) {
  SimulatedRobot robot;
  User user(robot);
  user.connect();
  constexpr int kKnee = 13;
  for (int trial = 0; trial < 5; ++trial) {
    for (int i = 0; i < 50; ++i) {
      user.client().commandJoints({{kKnee, 0.3 + 0.001 * i}}, milliseconds(40));
    }
    user.client().steer({});  // after every movement of a leg, the client has to let go
    for (int i = 0; i < 20; ++i) {
      user.client().steer({0.1, 0, 0});
      std::this_thread::sleep_for(milliseconds(10));
    }
    user.client().steer({});
    const auto count = static_cast<std::size_t>(trial) + 1;
    ASSERT_TRUE(user.await([&] { return user.walks_.size() >= count; }));
    EXPECT_NE(user.walks_.back().how, EndedHow::kReplaced) << user.walks_.back().reason;
  }
}

}  // namespace
