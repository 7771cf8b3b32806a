// Walking and postures, as a client of version 2 sees them.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "protocol/hello.h"
#include "protocol/walk_requests.h"
#include "rcserver/walk/Gait.h"
#include "rcserver_fixture.h"

namespace {

using namespace protocol::version2;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string steering(int forward, int left = 0, int turn = 0) {
  const protocol::version2::Velocity velocity = {forward * 1e-3, left * 1e-3, turn * 1e-3};
  return payloadOf(velocity);
}

std::string told(const Frame& frame) {
  MotorsAndPosture state = {};
  EXPECT_EQ(decode(frame.payload.data(), frame.payload.size(), &state), nullptr);
  return (state.motors_on ? "on " : "off ") + std::to_string(state.posture);
}

class WalkTest : public Version2Fixture {
 protected:
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
        EndMessage end = {};
        ASSERT_EQ(decode(next->payload.data(), next->payload.size(), &end), nullptr);
        ends_.push_back(std::to_string(end.what) + " " + std::to_string(end.how) + " " +
                        std::string(end.name, end.name_size) + ": " + std::string(end.reason, end.reason_size));
      } else if (next->header.kind == ERROR_MESSAGE && !next->payload.empty()) {
        errors_.push_back(payload.substr(2));
      } else if (next->header.kind == MOTORS_AND_POSTURE_PUSH && next->header.request_number == 0) {
        states_.push_back(told(*next));
      } else if (next->header.kind == TELEMETRY_PUSH && next->header.request_number == 0) {
        ASSERT_EQ(decode(next->payload.data(), next->payload.size(), &telemetry_), nullptr);
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

  bool stands() {
    robot_model::LegAngles legs[robot_model::NUMBER_OF_LEGS];
    Gait().FindPosture(0, {0, 0, 0}, 0, legs);
    return std::abs(robot_.joint("left_front_knee").position - legs[0].knee * 1e6) < 2 &&
           std::abs(robot_.joint("right_hind_rotator").position - legs[3].rotator * 1e6) < 2 &&
           std::abs(robot_.joint("right_front_elevator").position - legs[2].elevator * 1e6) < 2;
  }

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
  EXPECT_TRUE(hasCapability(hello, "S"));
  EXPECT_TRUE(hasCapability(hello, "E"));
  EXPECT_TRUE(hasCapability(hello, GUARD_CAPABILITY));
  const GaitParameters gait;
  EXPECT_DOUBLE_EQ(hello.walk.forward, gait.fastest);
  EXPECT_DOUBLE_EQ(hello.walk.back, gait.highest.back);
  EXPECT_DOUBLE_EQ(hello.walk.left, gait.highest.left);
  EXPECT_DOUBLE_EQ(hello.walk.turn, gait.highest.turn);
}

TEST_F(WalkTest, SteeringIsAnsweredByTheVelocityInForce) {
  const GaitParameters gait;
  const auto inForce = [this](int forward, int left, int turn) {
    const Frame answer = answerTo('S', 0, steering(forward, left, turn));
    protocol::version2::Velocity velocity = {};
    EXPECT_EQ(answer.header.kind, 's');
    EXPECT_EQ(decode(answer.payload.data(), answer.payload.size(), &velocity), nullptr);
    const auto whole = [](double value) { return static_cast<int>(std::lround(value * 1000)); };
    return std::vector<int>{whole(velocity.forward), whole(velocity.left), whole(velocity.turn)};
  };
  const int forward = static_cast<int>(std::lround(gait.highest.forward * 1000));
  const int left = static_cast<int>(std::lround(gait.highest.left * 1000));
  EXPECT_THAT(inForce(0, 0, 0), ElementsAre(0, 0, 0));
  EXPECT_THAT(inForce(50, -5, 100), ElementsAre(50, -5, 100));
  EXPECT_THAT(inForce(32767, 0, 0), ElementsAre(std::lround(gait.fastest * 1000), 0, 0));
  EXPECT_THAT(inForce(0, -32768, 0), ElementsAre(0, -left, 0));
  EXPECT_THAT(inForce(forward, left, 0), ElementsAre(forward / 2, left / 2, 0)) << "they share the legs' speed";
}

TEST_F(WalkTest, PutsItsFeetToTheSideToWhichItLeans) {
  std::vector<double> ahead;
  const std::vector<int>& path = robot_.joint("left_front_rotator").path;
  for (const int left : {-600000, 600000}) {
    robot_.sensor("acceleration_front_back") = left;  // its nose is up, and then down
    robot_.sensor("acceleration_right_left") = -left;
    walk();
    ahead.push_back(std::accumulate(path.end() - 100, path.end(), 0.0) / 100);
    const int outward = robot_.joint("left_front_elevator").position - robot_.joint("right_front_elevator").position;
    EXPECT_GT(left > 0 ? outward : -outward, 150000);
  }
  EXPECT_GT(ahead[1], ahead[0] + 50000);
}

TEST_F(WalkTest, TelemetryTellsHowItWalks) {
  EXPECT_EQ(answerTo('T', TELEMETRY_WITH_WALK | TELEMETRY_WITH_DUTY, std::string("\0\4", 2)).header.id, 3);
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

TEST_F(WalkTest, TelemetryOfAnOldClientIsAsBefore) {
  answerTo('T', 0, std::string("\0\4", 2));
  walk();
  EXPECT_THAT(walkInTelemetry(), IsEmpty());
  EXPECT_GT(telemetry_.count, 18);
}

TEST_F(WalkTest, EndsInTheStandWhenTheClientSteersSoOrNotAtAll) {
  walk();
  send(frame('S', 0, 1, steering(0)));
  pass(2 * kFramesASecond);
  EXPECT_TRUE(stands());
  EXPECT_THAT(ends_, ElementsAre("2 0 walk: "));
  walk();
  pass(2 * kFramesASecond);
  EXPECT_TRUE(stands());
  EXPECT_THAT(ends_, ElementsAre("2 0 walk: ", "2 2 walk: it was not steered for 500 ms"));
  EXPECT_THAT(console_.str(), HasSubstr("RCServer: walk has ended: it was not steered for 500 ms"));
}

TEST_F(WalkTest, MotionsOfTheLegsReplaceItAndAreReplaced) {
  walk();
  send(frame('P', 0, 1, playPayload("WAG.MTN", 1)));
  steer(100, 100);
  EXPECT_THAT(ends_, IsEmpty()) << "of the tail";
  send(frame('P', 0, 1, playPayload("SIT.MTN", 1)));
  steer(100, 50);
  EXPECT_THAT(ends_, ElementsAre("2 1 walk: a motion moves left_front_rotator"));
  EXPECT_THAT(errors_, Contains(HasSubstr("a motion moves left_front_rotator; let go first"))) << "the motion goes on";
  pass(70);
  EXPECT_EQ(ends_.size(), 1u);
  walk();
  EXPECT_THAT(ends_, Contains("1 1 SIT.MTN: the robot was told to walk or to take a posture"));
  file_keeper_.slowDown();
  send(frame('P', 0, 1, playPayload("SIT.MTN", 1)));
  ends_.clear();
  steer(100, 50);
  file_keeper_.speedUp();
  pass(20);
  EXPECT_THAT(ends_, ElementsAre("2 1 walk: a motion moves left_front_rotator")) << "steering on is no new command";
}

TEST_F(WalkTest, ASpeedLimitThatIsTooLowEndsItAndIsNoFaultOfAJoint) {
  walk();
  answerTo(
      'V', 0,
      payloadOf(SpeedLimits{
          1,
          {{robot_.model.joints[robot_model::findJointByName(robot_.model, "right_hind_knee")].identifier, 3000000}}}));
  pass(2 * kFramesASecond);
  EXPECT_THAT(ends_, ElementsAre("2 3 walk: the speed limit of right_hind_knee is too low for walking"));
  EXPECT_THAT(errors_, IsEmpty());
}

TEST_F(WalkTest, AMotionTellsThatItTookLongerBecauseTheServerWasHeldUp) {
  answerTo('P', 0, playPayload("NOD.MTN", 1));
  pass(20);
  clock_.step(100);
  pass(10 * kFramesASecond);
  ASSERT_EQ(ends_.size(), 1U);
  EXPECT_THAT(ends_[0], HasSubstr("1 0 NOD.MTN: the robot's program was held up, so it took "));
}

TEST_F(WalkTest, AfterARestTheRobotStandsAndSitsWithItsMotorsOnAgain) {
  for (const Posture posture : {POSTURE_STAND, POSTURE_SIT}) {
    answerTo('E', POSTURE_REST);
    pass(6 * kFramesASecond);
    ASSERT_TRUE(isLimp());
    expectRefusal(answerTo('E', POSTURE_REST), CODE_REFUSED, "the motors are off already");
    EXPECT_TRUE(answerTo('E', posture).payload.empty());
    pass(8 * kFramesASecond);
    EXPECT_FALSE(isLimp());
    EXPECT_EQ(ends_.back(), std::string("3 0 ") + postureName(posture) + ": ");
  }
}

// The rest levels the head. What moves it already ends, what is asked for later counts.
TEST_F(WalkTest, AMotionOfTheHeadDoesNotDefeatTheLevellingOfARest) {
  answerTo('P', 0, playPayload("NOD.MTN", 1000));
  pass(20);
  answerTo('E', POSTURE_REST);
  pass(6 * kFramesASecond);
  EXPECT_THAT(ends_, Contains("1 1 NOD.MTN: the robot was told to walk or to take a posture"));
  EXPECT_EQ(robot_.joint("head_tilt").position, 0);
  EXPECT_EQ(robot_.joint("neck_tilt").position, -174533);
}

TEST_F(WalkTest, TellsAClientThatAsksForItsMotorsAboutThemAndItsPosture) {
  pass(20);
  EXPECT_THAT(states_, IsEmpty()) << "a client that does not know it";
  send(frame('O', 0, 1));
  pass(20);
  EXPECT_THAT(states_, ElementsAre("on " + std::to_string(POSTURE_STAND)));
  send(frame('E', POSTURE_REST, 2));
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

// Everything waits behind a picture that the client does not read.
TEST_F(WalkTest, AFallThatItHasNoRoomToTellIsToldLater) {
  disconnect();
  robot_.showNoise();
  connectVersion2(4096);
  answerTo('O', 0);
  answerTo('E', POSTURE_STAND);
  pass(2 * kFramesASecond);
  EXPECT_THAT(states_, ElementsAre("on " + std::to_string(POSTURE_STAND)));
  send(frame('F', 100, 999, kLayerHigh));
  takeImage();
  for (int i = 0; i < 300; ++i) {
    send(frame('V', 0, 7));
  }
  robot_.layOnSide();
  passFrames(3 * kFramesASecond);
  EXPECT_TRUE(isLimp());
  const auto is_told = [this] {
    collect();
    return !errors_.empty();
  };
  EXPECT_TRUE(machine_->runUntil(is_told, std::chrono::seconds(5)));
  pass(20);
  EXPECT_THAT(errors_, ElementsAre("the robot has fallen: its motors are off, so that its legs are limp"));
  EXPECT_EQ(states_.back(), "off " + std::to_string(POSTURE_FALLEN));
}

// While a process is stopped, or the radio is out, what the client sends waits. Nobody wants it any more afterwards.
TEST_F(WalkTest, WhatHasWaitedWhileTheServerWasHeldUpDoesNotMoveTheRobot) {
  JointTargets head = {0, 1, {{2, 300000}}};
  const std::string pan = payloadOf(head);
  const std::vector<int> before = positions();
  client_->send(frame('J', 0, 1, pan) + frame('S', 0, 2, steering(100)) + frame('E', POSTURE_SIT, 3) +
                frame('P', 0, 4, playPayload("NOD.MTN", 1)) + frame('O', 0, 5, "\1") + frame('H', 0, 6));
  clock_.step(100);
  machine_->runPending();
  for (int number = 1; number <= 5; ++number) {
    expectRefusal(*nextFrame(), CODE_REFUSED, "too old: the robot's program or the link was held up");
  }
  EXPECT_EQ(nextFrame()->header.kind, 'h');
  passFrames(20);
  EXPECT_EQ(positions(), before);
  EXPECT_EQ(answerTo('J', 0, pan).header.kind, 'j') << "this is new";
  client_->send(frame('I', 0, 7) + frame('O', 0, 8, std::string(1, '\0')));
  clock_.step(100);
  machine_->runPending();
  EXPECT_EQ(nextFrame()->header.kind, 'i') << "to stop is never too late";
  EXPECT_EQ(nextFrame()->header.kind, 'o');
}

TEST_F(WalkTest, WhatComesAfterALongSilenceDoesNotMoveTheRobot) {
  answerTo('W', 85, kStreamOn);  // what it reads meanwhile does not count
  passFrames(180);
  JointTargets head = {0, 1, {{2, 300000}}};
  const std::string pan = payloadOf(head);
  EXPECT_EQ(answerTo('J', 0, pan).header.kind, 'j');
  passFrames(190);
  expectRefusal(answerTo('J', 0, pan), CODE_REFUSED, "too old");
  passFrames(13);
  EXPECT_EQ(answerTo('J', 0, pan).header.kind, 'j');
}

TEST_F(WalkTest, NorDoesWhatAClientOfVersion1HasSentToAServerThatWasHeldUp) {
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
  send(frame('E', POSTURE_REST, 1));
  pass(kFramesASecond);
  EXPECT_FALSE(isLimp());
  pass(4 * kFramesASecond);
  EXPECT_TRUE(rests());
  EXPECT_TRUE(isLimp());
  EXPECT_THAT(ends_, ElementsAre("2 1 walk: the robot was told to take a posture", "3 0 rest: "));
  expectRefusal(answerTo('S', 0, steering(10)), CODE_REFUSED, "the motors are off");
  EXPECT_EQ(answerTo('S', 0, steering(0)).header.kind, 's') << "there is nothing to stop";
}

TEST_F(WalkTest, BadRequestsAreRefused) {
  expectRefusal(answerTo('S', 0, "abc"), CODE_REFUSED, "bad request");
  expectRefusal(answerTo('E', 0), CODE_REFUSED, "bad request: the id is not one of the postures");
  expectRefusal(answerTo('E', 4), CODE_REFUSED, "bad request");
  expectRefusal(answerTo('E', 1, "a"), CODE_REFUSED, "bad request");
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
  expectRefusal(answerTo('E', POSTURE_SIT), CODE_REFUSED, "the robot lies on its right side; let it stand up first");
  pass(20);
  EXPECT_TRUE(isLimp());
  EXPECT_THAT(console_.str(), HasSubstr("RCServer: the robot lies on its right side: its motors go off"));
}

TEST_F(WalkTest, ARobotThatIsLiftedStops) {
  robot_.sensor("acceleration_up_down") = -9806650;
  const char* const paws[] = {"paw_left_front", "paw_left_hind", "paw_right_hind"};
  std::for_each(std::begin(paws), std::end(paws), [this](const char* paw) { robot_.sensor(paw) = 1; });
  walk();
  EXPECT_THAT(ends_, IsEmpty());
  std::for_each(std::begin(paws), std::end(paws), [this](const char* paw) { robot_.sensor(paw) = 0; });
  steer(100, 80);
  ASSERT_FALSE(ends_.empty());
  EXPECT_THAT(ends_.front(), HasSubstr("2 4 walk: the robot is carried"));
  EXPECT_FALSE(isLimp());
}

TEST_F(WalkTest, AGuardedOneSaysWhichPawFindsNoFloor) {
  for (const std::string paw : {"left front", "left hind", "right front", "right hind"}) {
    SetUp();
    robot_.sensor("acceleration_up_down") = -9806650;
    const auto sensorOf = [](std::string words) { return "paw_" + words.replace(words.find(' '), 1, "_"); };
    for (const char* other : {"left front", "left hind", "right front", "right hind"}) {
      robot_.sensor(sensorOf(other)) = 1;
    }
    ends_.clear();
    for (unsigned passed = 0; passed < 8 * kFramesASecond && ends_.empty(); passed += 12) {
      if (passed > 6 * kFramesASecond) {
        robot_.sensor(sensorOf(paw)) = 0;
      }
      send(frame('S', STEER_GUARDED, 900, steering(100)));
      pass(12);
    }
    EXPECT_THAT(ends_, ElementsAre("2 3 walk: the " + paw + " paw finds no floor: go back the way it came"));
  }
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
    live();
    EXPECT_EQ(answerTo('J', 0, payloadOf(targets)).header.kind, 'j');
    pass(2 * kFramesASecond);
    errors_.clear();
    for (unsigned passed = 0; passed < 4 * kFramesASecond; passed += 12) {
      send(frame('S', STEER_GUARDED, 900, steering(100)));
      pass(12);
    }
    EXPECT_EQ(::testing::Value(errors_, Contains(HasSubstr("something is in the way"))), stops);
    steer(0, 2 * kFramesASecond);
  }
}

TEST_F(WalkTest, ALowBatteryEndsItInTheStandAndThenTheRobotRests) {
  walk();
  robot_.power_status.robotStatus = orsbBATTERY_CAPACITY_LOW;
  bool stood = false;
  for (unsigned i = 0; i < 10 * kFramesASecond && machine_->isOn(); ++i) {
    passFrames(1);
    stood = stood || stands();
  }
  EXPECT_TRUE(stood);
  EXPECT_TRUE(rests());
  EXPECT_FALSE(machine_->isOn());
  EXPECT_THAT(console_.str(), HasSubstr("the battery is low: the robot lies down"));
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
  expectRefusal(answerTo('E', POSTURE_SIT), CODE_NOT_SUPPORTED, "not supported");
  Hello hello;
  const Frame answer = answerTo('H', 0);
  ASSERT_EQ(decodeHello(answer.payload.data(), answer.payload.size(), &hello), nullptr);
  EXPECT_FALSE(hasCapability(hello, "S") || hasCapability(hello, "E"));
  EXPECT_EQ(textOf(answer).find("walk_limits"), std::string::npos);
  EXPECT_EQ(answerTo('T', TELEMETRY_WITH_WALK, std::string("\0\4", 2)).header.id, TELEMETRY_PLAIN);
  machine_.reset();
}

}  // namespace
