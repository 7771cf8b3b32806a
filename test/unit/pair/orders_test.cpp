// Orders, and the truth about them, between the client library and a running server.
#include <gmock/gmock.h>

#include <condition_variable>
#include <csignal>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "aibo_client/rcserver_client.h"
#include "support/memory_stick.h"
#include "support/proxy/recording_proxy.h"
#include "support/safety_net.h"
#include "support/simulated_robot.h"

using namespace aibo_client;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test_support::kSafetyNet;
using test_support::MemoryStick;
using test_support::SimulatedRobot;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

constexpr int kHeadPan = 2;

/// A client, and what it has told.
class User {
 public:
  explicit User(const SimulatedRobot& robot, milliseconds read_timeout = seconds(10))
      : User(robot.port(), read_timeout) {}
  explicit User(int port, milliseconds read_timeout = seconds(10))
      : client_(options(port, read_timeout), callbacks()) {}
  ~User() { client_.stop(); }

  RcServerClient& client() { return client_; }

  void connect() {
    client_.setTelemetryPeriod(4);
    client_.start();
    ASSERT_TRUE(await([this] { return state_ == ConnectionState::kConnected && positions_.count(kHeadPan) > 0; }));
  }

  /// @return false if the condition does not become true in a generous time
  template <typename Condition>
  bool await(const Condition& condition) {
    std::unique_lock<std::mutex> lock(mutex_);
    return changed_.wait_for(lock, kSafetyNet, condition);
  }

  bool awaitRefusal() {
    return await([this] { return !refusals_.empty(); });
  }

  /// Whether it has been connected; the head's pan; and what the callbacks have got, under the lock of await().
  bool was_connected_ = false;
  ConnectionState state_ = ConnectionState::kDisconnected;
  std::string reason_;
  std::map<int, double> positions_;
  std::vector<Refusal> refusals_;
  std::vector<LateAnswer> late_answers_;
  std::vector<MotionEnd> ends_;
  MotorsAndPosture now_;
  int accepted_ = 0;

  double pan() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return positions_[kHeadPan];
  }

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
        state_ = status.state;
        was_connected_ = was_connected_ || state_ == ConnectionState::kConnected;
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
    callbacks.on_joints_accepted = [this](const std::vector<JointTarget>&) { change([&] { ++accepted_; }); };
    callbacks.on_refused = [this](const Refusal& refusal) { change([&] { refusals_.push_back(refusal); }); };
    callbacks.on_late_answer = [this](const LateAnswer& answer) { change([&] { late_answers_.push_back(answer); }); };
    callbacks.on_ended = [this](const MotionEnd& end) { change([&] { ends_.push_back(end); }); };
    callbacks.on_motors_and_posture = [this](const MotorsAndPosture& state) { change([&] { now_ = state; }); };
    return callbacks;
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  RcServerClient client_;
};

/// With a server of version 1 or 2.
class PairTest : public testing::TestWithParam<std::string> {
 protected:
  static std::vector<std::string> version(const std::vector<std::string>& more = {}) {
    std::vector<std::string> options = {"--protocol-version", GetParam()};
    options.insert(options.end(), more.begin(), more.end());
    return options;
  }
};

INSTANTIATE_TEST_SUITE_P(Versions, PairTest, testing::Values("1", "2"));

TEST_P(PairTest, AServerThatIsFrozenIsNotConnectedToUntilItAnswers) {
  SimulatedRobot robot(version());
  robot.process().signal(SIGSTOP);
  User user(robot, milliseconds(300));
  user.client().start();
  EXPECT_TRUE(user.await([&] { return user.reason_.find("sent nothing") != std::string::npos; }))
      << "it has not closed anything";
  EXPECT_FALSE(user.was_connected_);
  EXPECT_THROW(user.client().commandJoints({{kHeadPan, 0.1}}, milliseconds(0)), NetworkException);
  robot.process().signal(SIGCONT);
  EXPECT_TRUE(user.await([&] { return user.was_connected_; }));
}

TEST_P(PairTest, ACommandToALimpRobotIsRefusedWithItsJointAndItsOrder) {
  const MemoryStick stick("MOTORS_AT_BOOT=no\n");
  SimulatedRobot robot(version({"--memory-stick", stick.path()}));
  User user(robot);
  user.connect();
  OrderTerms terms;
  terms.number = 77;
  user.client().commandJoints({{kHeadPan, 0.5}}, milliseconds(0), terms);
  ASSERT_TRUE(user.awaitRefusal());
  EXPECT_EQ(user.refusals_[0].request, RefusedRequest::kJoints);
  EXPECT_EQ(user.refusals_[0].cause, RefusalCause::kRobot);
  EXPECT_EQ(user.refusals_[0].order, 77u);
  EXPECT_THAT(user.refusals_[0].ids, ElementsAre(kHeadPan));
  EXPECT_THAT(user.refusals_[0].reason, HasSubstr("motors"));
  EXPECT_EQ(user.accepted_, 0);
}

TEST_P(PairTest, AJointThatIsJammedIsNamed) {
  SimulatedRobot robot(version());
  User user(robot);
  user.connect();
  robot.type("jam head_pan");
  user.client().commandJoints({{kHeadPan, 1.0}}, milliseconds(0));
  ASSERT_TRUE(user.awaitRefusal());
  EXPECT_EQ(user.refusals_[0].cause, RefusalCause::kJointFault);
  EXPECT_THAT(user.refusals_[0].ids, ElementsAre(kHeadPan));
}

// Like a process under a debugger, or a computer that was asleep.
TEST_P(PairTest, WhatWaitedForAFrozenServerIsRefusedAndWhatComesAfterItIsNot) {
  SimulatedRobot robot(version());
  User user(robot);
  user.connect();
  const double before = user.pan();
  robot.process().signal(SIGSTOP);
  user.client().commandJoints({{kHeadPan, before + 0.5}}, milliseconds(0));
  std::this_thread::sleep_for(milliseconds(900));  // this wait is what is tested
  robot.process().signal(SIGCONT);
  ASSERT_TRUE(user.awaitRefusal());
  EXPECT_THAT(user.refusals_[0].ids, ElementsAre(kHeadPan));
  std::this_thread::sleep_for(milliseconds(300));  // as is this one: the head could move meanwhile
  EXPECT_NEAR(user.pan(), before, 0.02);
  user.client().commandJoints({{kHeadPan, before + 0.5}}, milliseconds(0));
  EXPECT_TRUE(user.await([&] { return user.positions_[kHeadPan] > before + 0.4; }));
}

TEST(PairOfVersion2Test, TheRobotTellsItsMotorsAndPosture) {
  SimulatedRobot robot;
  User user(robot);
  user.connect();
  const auto is = [&user](MotorState motors, PostureNow posture) {
    return user.await([&] { return user.now_ == MotorsAndPosture{motors, posture}; });
  };
  user.client().takePosture(Posture::kStand, seconds(5));
  EXPECT_TRUE(is(MotorState::kOn, PostureNow::kStanding));
  user.client().takePosture(Posture::kRest, seconds(5));
  EXPECT_TRUE(is(MotorState::kOff, PostureNow::kLying));
  user.client().takePosture(Posture::kSit, seconds(5));
  EXPECT_TRUE(is(MotorState::kOn, PostureNow::kSitting)) << "it has switched its motors on by itself";
  EXPECT_EQ(user.client().motorsAndPosture(), (MotorsAndPosture{MotorState::kOn, PostureNow::kSitting}));
  robot.kill();
  EXPECT_TRUE(is(MotorState::kUnknown, PostureNow::kUnknown));
}

TEST(PairOfVersion1Test, MotorsAndPostureStayUnknown) {
  SimulatedRobot robot({"--protocol-version", "1"});
  User user(robot);
  user.connect();
  EXPECT_EQ(user.client().motorsAndPosture(), MotorsAndPosture());
}

TEST(PairOfVersion2Test, AMotionThatBeginsAfterItsCallHasEndedIsTold) {
  SimulatedRobot robot({"--stick-time", "3000"});
  User user(robot);
  user.connect();
  OrderTerms terms;
  terms.number = 5;
  try {
    user.client().playMotion("NOD.MTN", 1, milliseconds(1000), terms);
    FAIL() << "the memory stick takes longer";
  } catch (const TimeoutException& error) {
    EXPECT_TRUE(error.wasSent());
    EXPECT_THAT(error.what(), HasSubstr("The robot may or may not play the motion NOD.MTN."));
  }
  ASSERT_TRUE(user.await([&] { return !user.late_answers_.empty(); }));
  EXPECT_EQ(user.late_answers_[0].order, 5u);
  EXPECT_TRUE(user.late_answers_[0].accepted);
  ASSERT_TRUE(user.await([&] { return !user.ends_.empty(); }));
  EXPECT_EQ(user.ends_[0].name, "NOD.MTN");
  EXPECT_EQ(user.ends_[0].how, EndedHow::kDone);
}

TEST(PairOfVersion2Test, AMotionThatWaitsBehindAnotherForTheMemoryStickIsTooOld) {
  SimulatedRobot robot({"--stick-time", "1500"});
  test_support::RecordingProxy proxy(robot.port());
  User user(proxy.port());
  user.connect();
  std::thread other([&user] { user.client().listMotions(kSafetyNet); });
  EXPECT_TRUE(proxy.waitForRequest("N", kSafetyNet)) << "the list is asked for first";
  try {
    user.client().playMotion("NOD.MTN", 1, kSafetyNet);
    ADD_FAILURE() << "it has waited";
  } catch (const CommandException& error) {
    EXPECT_THAT(error.what(), HasSubstr("too old"));
  }
  other.join();
}

TEST(PairOfVersion2Test, AFullMemoryStickTakesNoPictureUntilItIsEmptied) {
  const MemoryStick stick("ALLOW_PICTURES=yes\n");
  SimulatedRobot robot({"--memory-stick", stick.path()});
  User user(robot);
  user.connect();
  EXPECT_EQ(robot.type("stick full"), "ok: stick full\n");
  EXPECT_THROW(user.client().takePictureOnRobot(85, kSafetyNet), CommandException);
  EXPECT_EQ(robot.type("stick ready"), "ok: stick ready\n");
  EXPECT_EQ(user.client().takePictureOnRobot(85, kSafetyNet), "AIBO0001.JPG");
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
    for (int i = 0; i < 20; ++i) {
      user.client().steer({0.1, 0, 0});
      std::this_thread::sleep_for(milliseconds(10));
    }
    user.client().steer({});
    const auto count = static_cast<std::size_t>(trial) + 1;
    ASSERT_TRUE(user.await([&] { return user.ends_.size() >= count; }));
    EXPECT_NE(user.ends_.back().how, EndedHow::kReplaced) << user.ends_.back().reason;
  }
}

}  // namespace
