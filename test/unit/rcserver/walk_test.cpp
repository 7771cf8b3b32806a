// Walking and postures, as a client of version 2 sees them.

#include <cmath>
#include <cstdlib>

#include "protocol/color_requests.h"
#include "rcserver_fixture.h"
#include "simulator/ers7/simulated_ers7.h"

namespace {

using namespace protocol::version2;
using simulated_ers7::SimulatedErs7;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Velocity = protocol::version2::Velocity;

std::string steering(int forward, int turn = 0, int left = 0) {
  return payloadOf(SteeringOrder{NEVER_TOO_OLD, {forward * 1e-3, left * 1e-3, turn * 1e-3}});
}

class WalkTest : public Version2Fixture {
 protected:
  void SetUp() override {
    Version2Fixture::SetUp();
    letGo();
  }

  // A walk begins only after zeros.
  void letGo() { answerTo('S', 0, steering(0)); }

  // Steers as a client does.
  void steer(int forward, unsigned frames, int turn = 0, int left = 0) {
    for (unsigned passed = 0; passed < frames; passed += 12) {
      send(frame('S', 0, 900, steering(forward, turn, left)));
      pass(std::min(12U, frames - passed));
    }
  }

  // Collects what is sent.
  void pass(unsigned frames) {
    for (unsigned i = 0; i < frames && machine_->isOn(); ++i) {
      if (i % 100 == 0) {
        send(frame('H', 0, 901));
      }
      passFrames(1);
      while (const auto next = client_->nextFrame()) {
        frames_.push_back(*next);
      }
    }
  }

  std::map<int, int> walkInTelemetry() const {
    const auto newest = std::find_if(frames_.rbegin(), frames_.rend(),
                                     [](const Frame& next) { return next.header.kind == TELEMETRY_PUSH; });
    return valuesIn(*newest, GROUP_WALK);
  }

  // It stands at once with joints at 0, and rises from there.
  void walk(int forward = 100) { steer(forward, 4 * kFramesASecond); }

  std::vector<Frame> frames_;
};

TEST_F(WalkTest, TelemetryTellsHowItWalks) {
  EXPECT_EQ(answerTo('T', TELEMETRY_PLAIN, std::string("\0\4", 2)).header.id, TELEMETRY_PLAIN);
  pass(20);
  EXPECT_EQ(walkInTelemetry()[WALK_STATE], WALK_STATE_NONE);
  EXPECT_EQ(walkInTelemetry()[WALK_FORWARD], 0);
  EXPECT_EQ(walkInTelemetry()[WALK_PHASE], 0);
  steer(100, 20);
  EXPECT_EQ(walkInTelemetry()[WALK_STATE], WALK_STATE_GETS_READY);
  steer(50, 500, 200);
  EXPECT_EQ(walkInTelemetry()[WALK_STATE], WALK_STATE_WALKS);
  EXPECT_NEAR(walkInTelemetry()[WALK_FORWARD], 50000, 1500);
  EXPECT_NEAR(walkInTelemetry()[WALK_TURN], 200000, 10000);
  const int phase = walkInTelemetry()[WALK_PHASE];
  EXPECT_GE(phase, 0);
  EXPECT_LT(phase, 1000000);
  steer(50, 12);
  EXPECT_NE(walkInTelemetry()[WALK_PHASE], phase);
  steer(0, 500, 0, 30);
  EXPECT_NEAR(walkInTelemetry()[WALK_LEFT], 30000, 2000);
}

TEST_F(WalkTest, AfterARestTheRobotStandsAndSitsWithItsMotorsOnAgain) {
  for (const Posture posture : {POSTURE_STAND, POSTURE_SIT}) {
    answerTo('E', POSTURE_REST, order());
    pass(6 * kFramesASecond);
    ASSERT_TRUE(isLimp());
    expectRefusal(answerTo('E', POSTURE_REST, order()), CODE_REFUSED, "the motors are off already");
    EXPECT_TRUE(answerTo('E', posture, order()).payload.empty());
    pass(8 * kFramesASecond);
    EXPECT_FALSE(isLimp());
    EXPECT_THAT(told(frames_), Contains("i" + std::to_string(last_number_) + " 0"));
  }
}

TEST_F(WalkTest, TellsItsMotorsAndItsPostureFromTheFirstMeasurementOn) {
  const auto states = [this] {
    std::vector<std::string> all;
    for (const Frame& next : frames_) {
      if (next.header.kind == MOTORS_AND_POSTURE_PUSH && next.header.request_number == 0) {
        const auto state = payloadIn<MotorsAndPosture>(next);
        all.push_back((state.motors_on ? "on " : "off ") + std::to_string(state.posture));
      }
    }
    return all;
  };
  reconnect();
  pass(20);
  EXPECT_THAT(states(), ElementsAre("on " + std::to_string(POSTURE_STAND)));
  send(frame('E', POSTURE_REST, 2, order()));
  pass(6 * kFramesASecond);
  EXPECT_THAT(states(), Contains("on " + std::to_string(POSTURE_REST)));
  EXPECT_EQ(states().back(), "off " + std::to_string(POSTURE_REST));
  robot_.layOnSide();
  pass(kFramesASecond);
  EXPECT_EQ(states().back(), "off " + std::to_string(POSTURE_FALLEN));
  const size_t count = states().size();
  pass(kFramesASecond);
  EXPECT_EQ(states().size(), count) << "nothing changes";
}

// While a process is stopped, what the client sends waits. Nobody wants it any more afterwards.
TEST_F(WalkTest, WhatWaitedInVersion1WhileTheServerWasHeldUpMovesNothing) {
  disconnect();
  client_ = connectServed();
  for (const std::string& bytes : {request('J', 2, 1000), request('J', 0, 1000), fileRequest('P', "WAG.MTN", 1)}) {
    client_->send(bytes);
    clock_.step(100);
    machine_->runPending();
    EXPECT_EQ(awaitLetter(*client_), 'e') << bytes;
  }
  passFrames(20);
  expectAnswer(request('J', 2, 1000), 'j', 2, 1000);
}

TEST_F(WalkTest, AFallIsSaidAloudAndTheLegsGoSoftAfterASecond) {
  walk();
  robot_.layOnSide();
  steer(100, 84);
  EXPECT_THAT(told(frames_), Contains("i900 4"));
  EXPECT_THAT(told(frames_), Contains(HasSubstr("the robot lies on its right side; let it stand up first")));
  EXPECT_FALSE(isLimp());
  pass(70);
  EXPECT_TRUE(isLimp());
  EXPECT_THAT(told(frames_), Contains("e0 0 the robot has fallen: its motors are off, so that its legs are limp"));
  expectRefusal(answerTo('E', POSTURE_SIT, order()), CODE_REFUSED,
                "the robot lies on its right side; let it stand up first");
  EXPECT_THAT(console_.str(), HasSubstr("RCServer: the robot lies on its right side: its motors go off"));
}

TEST_F(WalkTest, ThePauseButtonDoesSoTooAndCutsTheMotorsWhenItIsPressedAgain) {
  for (const bool walks : {true, false}) {
    robot_.power_status.robotStatus = 0;
    SetUp();
    if (walks) {
      walk();
    } else {
      answerTo('E', POSTURE_SIT, order());
      pass(20);
    }
    robot_.power_status.robotStatus = orsbPAUSE;
    passFrames(kFramesASecond / 2);
    EXPECT_FALSE(isLimp()) << walks;
    robot_.power_status.robotStatus = 0;
    passFrames(kFramesASecond);
    ASSERT_TRUE(machine_->isOn()) << walks;
    EXPECT_THAT(console_.str(), HasSubstr("the pause button was pressed: the robot lies down"));
    robot_.power_status.robotStatus = orsbPAUSE;
    passFrames(1);
    EXPECT_TRUE(isLimp()) << walks;
    EXPECT_FALSE(machine_->isOn()) << walks;
  }
}

TEST_F(WalkTest, AnErs210CannotWalk) {
  FakeRobot other("ERS-210");
  machine_.reset();
  boot(other);
  passFrames(kUntilMeasured);
  connectVersion2();
  expectRefusal(answerTo('S', 0, steering(10)), CODE_NOT_SUPPORTED, "not supported");
  expectRefusal(answerTo('E', POSTURE_SIT, order()), CODE_NOT_SUPPORTED, "not supported");
  EXPECT_EQ(std::string(hello().capabilities).find_first_of("SE"), std::string::npos);
  EXPECT_EQ(textOf(answerTo('H', 0)).find("walk_limits"), std::string::npos);
  EXPECT_EQ(answerTo('Z', COLORS_TABLE, payloadOf(ColorTable{7, {}})).header.kind, 'z') << "an ERS-7 lacks channel 7";
  EXPECT_EQ(answerTo('T', TELEMETRY_PLAIN, std::string("\0\4", 2)).header.id, TELEMETRY_PLAIN);
  machine_.reset();
}

// Guarded walks on a table with edges and a board, with the robot's own program on the simulated ERS-7.
// AIBO_WHOLE_CAMPAIGN lets it drive a hundred times.
constexpr unsigned kFramesBetweenSteering = 12;

class GuardedWalkTest : public FakeRobotFixture {
 protected:
  void begin(std::uint64_t seed) {
    machine_.reset();
    SimulatedErs7::Options options;
    options.on_table = true;
    options.seed = seed;
    walker_ = std::make_unique<SimulatedErs7>(options);
    boot(*walker_);
    passFrames(kUntilMeasured);
    connectVersion2();
    client_->send(frame('T', TELEMETRY_PLAIN, 1, {0, 4}));
    longest_push_ = walked_ = pushed_ = 0;
    last_ = walker_->pose();
    client_->send(frame('E', POSTURE_STAND, 2, order()));
    pass(4);
    steer({0, 0, 0}, 1.5);  // it lets go
  }

  void TearDown() override {
    machine_.reset();
    walker_.reset();
  }

  void steer(const Velocity& velocity, double seconds) {
    for (double passed = 0; passed < seconds; passed += kFramesBetweenSteering * 0.008) {
      client_->send(frame('S', STEER_GUARDED, 3, payloadOf(SteeringOrder{NEVER_TOO_OLD, velocity})));
      pass(kFramesBetweenSteering * 0.008);
    }
  }

  void pass(double seconds) {
    for (double passed = 0; passed < seconds - 1e-9; passed += 0.008) {
      if (frames_++ % 100 == 0) {
        client_->send(frame('H', 0, 2));
      }
      passFrames(1);
      listen();
      watch();
    }
  }

  void listen() {
    for (const Frame& next : arrived()) {
      if (next.header.kind == END_PUSH) {
        last_end_ = textOf(next);
      } else if (next.header.kind == TELEMETRY_PUSH && next.header.request_number == 0) {
        std::map<int, int> values = valuesIn(next, GROUP_WALK);
        walked_ = std::hypot(values[WALK_FORWARD], values[WALK_LEFT]) * 1e-6;
      }
    }
  }

  void watch() {
    const simulated_ers7::Place& place = walker_->pose();
    const double way = std::hypot(place.x - last_.x, place.y - last_.y);
    last_ = place;
    const bool is_pushed = walker_->travel().isStopped() && walked_ > 0.01 && way / 0.008 < walked_ / 2;
    // A push goes on through the moments of a step in which the feet hardly move.
    pushed_ = is_pushed ? pushed_ + 0.008 : std::max(0.0, pushed_ - 0.004);
    longest_push_ = std::max(longest_push_, pushed_);  // s
  }

  void drive(std::uint64_t seed) {
    begin(seed);
    std::mt19937_64 random(seed);
    const auto draw = [&random](double least, double most) {
      return least + (most - least) * static_cast<double>(random() % 1000001) / 1e6;
    };
    for (double passed = 0; passed < 60 && !walker_->travel().hasFallenOff();) {
      const double seconds = draw(0.5, 4);
      const double kind = draw(0, 1);
      Velocity velocity = {0, 0, 0};
      if (kind < 0.5) {
        velocity = {draw(0.03, 0.3), 0, draw(0, 1) < 0.5 ? 0 : draw(-0.6, 0.6)};
      } else if (kind < 0.65) {
        velocity.forward = draw(-0.1, 0);
      } else if (kind < 0.75) {
        velocity.left = draw(-0.06, 0.06);
      } else if (kind < 0.9) {
        velocity.turn = draw(-1.2, 1.2);
      } else {
        velocity = {draw(-0.1, 0.3), draw(-0.06, 0.06), draw(-1.2, 1.2)};
      }
      steer(velocity, seconds);
      steer({0, 0, 0}, 0.1);
      passed += seconds + 0.1;
    }
  }

  std::unique_ptr<SimulatedErs7> walker_;
  double longest_push_ = 0;  ///< s; the board takes more than half of the way that the legs walk
  std::string last_end_;
  simulated_ers7::Place last_;
  double walked_ = 0;
  double pushed_ = 0;
  unsigned frames_ = 0;
};

TEST_F(GuardedWalkTest, NeitherFallsOffATableNorPushesABoardHoweverItIsSteered) {
  for (unsigned i = 1; i <= (std::getenv("AIBO_WHOLE_CAMPAIGN") != nullptr ? 100 : 6); ++i) {
    drive(i);
    EXPECT_FALSE(walker_->travel().hasFallenOff()) << "drive " << i << ", " << last_end_;
    EXPECT_LT(longest_push_, 1) << "drive " << i;
  }
}

}  // namespace
