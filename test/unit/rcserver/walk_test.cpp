// Walking and postures, as a client of version 2 sees them.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "protocol/hello.h"
#include "protocol/walk_requests.h"
#include "rcserver/walk/Gait.h"
#include "rcserver_fixture.h"

namespace {

using namespace protocol::version2;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string steering(int forward, int left = 0, int turn = 0) {
  const protocol::version2::Velocity velocity = {forward * 1e-3, left * 1e-3, turn * 1e-3};
  return payloadOf(SteeringOrder{NEVER_TOO_OLD, velocity});
}

std::string told(const Frame& frame) {
  const auto state = payloadIn<MotorsAndPosture>(frame);
  return (state.motors_on ? "on " : "off ") + std::to_string(state.posture);
}

class WalkTest : public Version2Fixture {
 protected:
  void SetUp() override {
    Version2Fixture::SetUp();
    letGo();
  }

  // A walk begins only after zeros.
  void letGo() { answerTo('S', 0, steering(0)); }

  // Steers as a client does, and collects what is pushed.
  void steer(int forward, unsigned frames, int left = 0, int turn = 0) {
    for (unsigned passed = 0; passed < frames; passed += 12) {
      send(frame('S', 0, 900, steering(forward, left, turn)));
      pass(std::min(12U, frames - passed));
    }
  }

  void pass(unsigned frames) {
    for (unsigned i = 0; i < frames && machine_->isOn(); ++i) {
      if (i % 100 == 0) {
        send(frame('H', 0, 901));
      }
      passFrames(1);
      collect();
    }
  }

  void collect() {
    while (const auto next = client_->nextFrame()) {
      const std::string payload = textOf(*next);
      if (next->header.kind == END_PUSH && next->header.request_number == 0) {
        const auto end = payloadIn<EndMessage>(*next);
        ends_.push_back(std::to_string(end.what) + " " + std::to_string(end.how) + " " +
                        std::string(end.name, end.name_size) + ": " + std::string(end.reason, end.reason_size));
      } else if (next->header.kind == ERROR_MESSAGE && !next->payload.empty()) {
        errors_.push_back(payload.substr(2));
      } else if (next->header.kind == MOTORS_AND_POSTURE_PUSH && next->header.request_number == 0) {
        states_.push_back(told(*next));
      } else if (next->header.kind == TELEMETRY_PUSH && next->header.request_number == 0) {
        telemetry_ = payloadIn<Telemetry>(*next);
      }
    }
  }

  std::map<int, int> walkInTelemetry() const {
    std::map<int, int> values;
    for (size_t i = 0; i < telemetry_.count; ++i) {
      if (telemetry_.entries[i].group == GROUP_WALK) {
        values[telemetry_.entries[i].id] = telemetry_.entries[i].value;
      }
    }
    return values;
  }

  // It stands at once with joints at 0, and rises from there.
  void walk(int forward = 100) { steer(forward, 4 * kFramesASecond); }

  bool rests() {
    return std::abs(robot_.joint("left_front_rotator").position - 1134464) < 2 &&
           std::abs(robot_.joint("right_hind_rotator").position + 1134464) < 2;
  }

  bool isLimp() const {
    return std::none_of(robot_.joints.begin(), robot_.joints.end(),
                        [](const FakeRobot::FakeJoint& joint) { return joint.gain; });
  }

  std::vector<std::string> ends_;
  std::vector<std::string> errors_;
  std::vector<std::string> states_;  ///< of motors and posture
  Telemetry telemetry_{};
};

TEST_F(WalkTest, HelloHasItsLimits) {
  Hello hello;
  const Frame answer = answerTo('H', 0);
  ASSERT_EQ(decodeHello(answer.payload.data(), answer.payload.size(), &hello), nullptr);
  const GaitParameters gait;
  EXPECT_DOUBLE_EQ(hello.walk.forward, gait.fastest);
  EXPECT_DOUBLE_EQ(hello.walk.back, gait.highest.back);
  EXPECT_DOUBLE_EQ(hello.walk.left, gait.highest.left);
  EXPECT_DOUBLE_EQ(hello.walk.turn, gait.highest.turn);
}

TEST_F(WalkTest, VelocityInForceCanBeSentBackUnchanged) {
  const auto steered = payloadIn<SteeringReply>(answerTo('S', 0, steering(50, -5, 100)));
  EXPECT_DOUBLE_EQ(steered.velocity.forward, 0.05);
  EXPECT_DOUBLE_EQ(steered.velocity.left, -0.005);
  EXPECT_DOUBLE_EQ(steered.velocity.turn, 0.1);
}

TEST_F(WalkTest, TelemetryTellsHowItWalks) {
  EXPECT_EQ(answerTo('T', TELEMETRY_PLAIN, std::string("\0\4", 2)).header.id, TELEMETRY_PLAIN);
  pass(20);
  EXPECT_EQ(walkInTelemetry()[WALK_STATE], WALK_STATE_NONE);
  EXPECT_EQ(walkInTelemetry()[WALK_FORWARD], 0);
  steer(100, 20);
  EXPECT_EQ(walkInTelemetry()[WALK_STATE], WALK_STATE_GETS_READY);
  steer(50, 500, 0, 200);
  EXPECT_EQ(walkInTelemetry()[WALK_STATE], WALK_STATE_WALKS);
  EXPECT_NEAR(walkInTelemetry()[WALK_FORWARD], 50000, 1500);
  EXPECT_NEAR(walkInTelemetry()[WALK_TURN], 200000, 10000);
  const int phase = walkInTelemetry()[WALK_PHASE];
  EXPECT_GE(phase, 0);
  EXPECT_LT(phase, 1000000);
  steer(50, 12);
  EXPECT_NE(walkInTelemetry()[WALK_PHASE], phase);
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
    EXPECT_EQ(ends_.back(), std::string("3 0 ") + postureName(posture) + ": ");
  }
}

TEST_F(WalkTest, TellsItsMotorsAndItsPostureFromTheFirstMeasurementOn) {
  reconnect();
  pass(20);
  EXPECT_THAT(states_, ElementsAre("on " + std::to_string(POSTURE_STAND)));
  send(frame('E', POSTURE_REST, 2, order()));
  pass(6 * kFramesASecond);
  EXPECT_THAT(states_, Contains("on " + std::to_string(POSTURE_REST)));
  EXPECT_EQ(states_.back(), "off " + std::to_string(POSTURE_REST));
  robot_.layOnSide();
  pass(kFramesASecond);
  EXPECT_EQ(states_.back(), "off " + std::to_string(POSTURE_FALLEN));
  const size_t count = states_.size();
  pass(kFramesASecond);
  EXPECT_EQ(states_.size(), count) << "nothing changes";
}

// While a process is stopped, what the client sends waits. Nobody wants it any more afterwards.
TEST_F(WalkTest, WhatAClientOfVersion1HasSentToAServerThatWasHeldUpDoesNotMoveTheRobot) {
  disconnect();
  client_ = connectServed();
  for (const int joint : {2, 0}) {  // one of them, and all
    client_->send(request('J', joint, 1000));
    clock_.step(100);
    machine_->runPending();
    EXPECT_EQ(awaitLetter(*client_), 'e');
  }
  passFrames(20);
  expectAnswer(request('J', 2, 1000), 'j', 2, 1000);
}

TEST_F(WalkTest, RestsAndThenSwitchesTheMotorsOff) {
  walk();
  send(frame('E', POSTURE_REST, 1, order()));
  pass(kFramesASecond);
  EXPECT_FALSE(isLimp());
  pass(4 * kFramesASecond);
  EXPECT_TRUE(rests());
  EXPECT_TRUE(isLimp());
  EXPECT_THAT(ends_, ElementsAre("2 1 walk: the robot was told to take a posture", "3 0 rest: "));
  expectRefusal(answerTo('S', 0, steering(10)), CODE_REFUSED, "the motors are off");
  EXPECT_EQ(answerTo('S', 0, steering(0)).header.kind, 's') << "there is nothing to stop";
}

TEST_F(WalkTest, AFallIsSaidAloudAndTheLegsGoSoftAfterASecond) {
  walk();
  robot_.layOnSide();
  steer(100, 84);
  EXPECT_THAT(ends_, ElementsAre("2 4 walk: the robot lies on its right side"));
  EXPECT_THAT(errors_, Contains(HasSubstr("the robot lies on its right side; let it stand up first")));
  EXPECT_FALSE(isLimp());
  pass(70);
  EXPECT_TRUE(isLimp());
  EXPECT_THAT(errors_, Contains("the robot has fallen: its motors are off, so that its legs are limp"));
  expectRefusal(answerTo('E', POSTURE_SIT, order()), CODE_REFUSED,
                "the robot lies on its right side; let it stand up first");
  pass(20);
  EXPECT_TRUE(isLimp());
  EXPECT_THAT(console_.str(), HasSubstr("RCServer: the robot lies on its right side: its motors go off"));
}

TEST_F(WalkTest, AGuardedOneStopsBeforeWhatTheHeadLooksAt) {
  robot_.sensor("acceleration_up_down") = -9806650;
  const std::tuple<std::array<JointValue, 3>, bool, bool> cases[] = {
      {{{{1, 0}, {2, 0}, {3, 0}}}, false, true},
      {{{{1, 0}, {2, 0}, {3, 700000}}}, true, false},        // it is over the head
      {{{{1, 0}, {2, 1200000}, {3, 0}}}, false, false},      // it is beside the robot
      {{{{1, -1000000}, {2, 0}, {3, 700000}}}, true, true},  // the neck is down
  };
  for (const auto& [head, is_near, stops] : cases) {
    SCOPED_TRACE(head[0].value + head[1].value + head[2].value);
    robot_.sensor("range_near") = is_near ? 50000 : 500000;  // the end of its range
    robot_.sensor("range_far") = is_near ? 1500000 : 50000;
    JointTargets targets = {0, 3, {}};
    std::copy(head.begin(), head.end(), targets.joints);
    EXPECT_EQ(answerTo('J', 0, order(payloadOf(targets))).header.kind, 'j');
    pass(2 * kFramesASecond);
    errors_.clear();
    letGo();
    for (unsigned passed = 0; passed < 4 * kFramesASecond; passed += 12) {
      send(frame('S', STEER_GUARDED, 900, steering(100)));
      pass(12);
    }
    EXPECT_EQ(::testing::Value(errors_, Contains(HasSubstr("something is in the way"))), stops);
    steer(0, 2 * kFramesASecond);
  }
}

TEST_F(WalkTest, ThePauseButtonDoesSoTooAndCutsTheMotorsWhenItIsPressedAgain) {
  walk();
  robot_.power_status.robotStatus = orsbPAUSE;
  passFrames(kFramesASecond / 2);
  EXPECT_FALSE(isLimp());
  robot_.power_status.robotStatus = 0;
  passFrames(kFramesASecond);
  ASSERT_TRUE(machine_->isOn());
  EXPECT_THAT(console_.str(), HasSubstr("the pause button was pressed: the robot lies down"));
  robot_.power_status.robotStatus = orsbPAUSE;
  passFrames(1);
  EXPECT_TRUE(isLimp());
  EXPECT_FALSE(machine_->isOn());
}

TEST_F(WalkTest, AnErs210CannotWalk) {
  FakeRobot other("ERS-210");
  machine_.reset();
  boot(other);
  passFrames(kUntilMeasured);
  connectVersion2();
  expectRefusal(answerTo('S', 0, steering(10)), CODE_NOT_SUPPORTED, "not supported");
  expectRefusal(answerTo('E', POSTURE_SIT, order()), CODE_NOT_SUPPORTED, "not supported");
  Hello hello;
  const Frame answer = answerTo('H', 0);
  ASSERT_EQ(decodeHello(answer.payload.data(), answer.payload.size(), &hello), nullptr);
  EXPECT_EQ(std::string(hello.capabilities).find_first_of("SE"), std::string::npos);
  EXPECT_EQ(textOf(answer).find("walk_limits"), std::string::npos);
  EXPECT_EQ(answerTo('T', TELEMETRY_PLAIN, std::string("\0\4", 2)).header.id, TELEMETRY_PLAIN);
  machine_.reset();
}

}  // namespace
