// Walking and postures, as a client of version 2 sees them.

#include <array>
#include <random>

#include "protocol/color_requests.h"
#include "rcserver_fixture.h"
#include "simulator/ers7/simulated_ers7.h"

namespace {

using namespace protocol::version2;
using simulated_ers7::SimulatedErs7;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

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
  void steer(int forward, unsigned frames, int turn = 0, int left = 0, int mode = 0) {
    for (unsigned passed = 0; passed < frames; passed += 12) {
      send(frame('S', mode, 900, steering(forward, turn, left)));
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

// The robot's own program walks the simulated ERS-7 over a table with edges.
TEST_F(WalkTest, TheGuardKeepsItOnATableHoweverItIsSteered) {
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
    SimulatedErs7::Options options;
    options.on_table = true;
    options.seed = seed;
    SimulatedErs7 walker(options);
    machine_.reset();
    boot(walker);
    passFrames(kUntilMeasured);
    connectVersion2();
    std::mt19937 random(seed);
    const auto draw = [&random](int least, int most) {
      return least + static_cast<int>(random() % static_cast<unsigned>(most - least));
    };
    for (int i = 0; i < 30; ++i) {
      const auto [forward, turn, left, frames, axes] =
          std::array{draw(-100, 300), draw(-1200, 1200), draw(-60, 60), draw(60, 500), draw(0, 4)};
      steer(0, 12, 0, 0, STEER_GUARDED);
      steer(forward, static_cast<unsigned>(frames), axes % 2 * turn, axes / 3 * left, STEER_GUARDED);
    }
    EXPECT_FALSE(walker.travel().hasFallenOff()) << seed;
    machine_.reset();
  }
}

}  // namespace
