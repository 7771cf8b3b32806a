// Joints in version 1, and the motors at boot.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "protocol/units.h"
#include "protocol/version1.h"
#include "rcserver_fixture.h"
#include "robot_model/robot_model.h"
#include "simulator/ers7/simulated_ers7.h"

namespace {

using protocol::centidegreesFromMicroradians;
using protocol::microradiansFromCentidegrees;
using robot_model::Joint;
using ::testing::Each;
using ::testing::Field;
using ::testing::HasSubstr;

constexpr int kNeckTilt = 1;
constexpr int kHeadPan = 2;
constexpr int kTailPan = 51;
constexpr int kTailTilt = 52;

// More than enough for any motion with the standard limits.
constexpr unsigned kLongestWay = 500;

class JointsTest : public FakeRobotFixture {
 protected:
  void SetUp() override { start(); }

  void start() {
    FakeRobotFixture::start();
    client_ = connectServed();
  }
};

// ---------------------------------------------------------------------------------------------------------- booting

TEST_F(JointsTest, StartHoldsAllJointsWhereTheyAreWithTheGainsOfTheTable) {
  for (size_t i = 0; i < robot_.joints.size(); ++i) {
    const FakeRobot::FakeJoint& joint = robot_.joints[i];
    const robot_model::PidGains& gains = robot_.model.joints[i].gains;
    EXPECT_TRUE(joint.gain);
    EXPECT_THAT(joint.path, Each(joint.path.front()));
    EXPECT_EQ(joint.gains.proportional, gains.proportional);
    EXPECT_EQ(joint.gains.integral, gains.integral);
    EXPECT_EQ(joint.gains.derivative, gains.derivative);
    EXPECT_EQ(joint.gains.proportional_shift, gains.proportional_shift);
    EXPECT_EQ(joint.gains.integral_shift, gains.integral_shift);
    EXPECT_EQ(joint.gains.derivative_shift, gains.derivative_shift);
  }
  EXPECT_TRUE(robot_.powered);
}

TEST_F(JointsTest, GainsGoOnOnlyAfterThePresentPositionsWereCommanded) {
  machine_.reset();
  for (FakeRobot::FakeJoint& joint : robot_.joints) {
    joint.gain = false;
    joint.gains = {};
    joint.reference = 12345;  // an earlier program's last command
    joint.path.clear();
  }
  start();
  for (const FakeRobot::FakeJoint& joint : robot_.joints) {
    EXPECT_TRUE(joint.gain);
    EXPECT_EQ(joint.error_when_gain_went_on, 0);
    EXPECT_THAT(joint.path, Each(joint.path.front()));
  }
}

TEST_F(JointsTest, RobotWithAMissingJointSendsPicturesAndRefusesToMove) {
  machine_.reset();
  robot_.missing_locator = robot_.model.joints[3].locator;
  start();
  EXPECT_THAT(console_.str(), HasSubstr(robot_.missing_locator));
  expectError(request('J', kHeadPan));
  expectError(request('J', kHeadPan, 100));
  client_->send(request('F', 85));
  passFrames(FakeRobot::kFramesPerImage);
  EXPECT_EQ(awaitLetter(*client_), 'f');
}

TEST_F(JointsTest, JointsThatGetNoGainAreNamedOnTheConsoleAndTheOthersHold) {
  machine_.reset();
  robot_.joint("mouth").refuses_gain = true;
  robot_.joint("tail_pan").refuses_gains = true;
  start();
  EXPECT_THAT(console_.str(), HasSubstr("mouth is limp: its gain cannot be enabled (status 8192)"));
  EXPECT_THAT(console_.str(), HasSubstr("tail_pan is limp: its gain cannot be set (status 2)"));
  EXPECT_NE(robot_.joint("head_pan").gains.proportional, 0);
}

TEST_F(JointsTest, PrimitivesAreClosedWhenTheRobotShutsDown) {
  machine_->shutdown();
  EXPECT_THAT(robot_.joints, Each(Field(&FakeRobot::FakeJoint::open, false)));
}

// ---------------------------------------------------------------------------------------------------- version 1: J

TEST_F(JointsTest, EveryJointIsReadAndSetByItsIdentifier) {
  for (size_t i = 0; i < robot_.joints.size(); ++i) {
    const Joint& joint = robot_.model.joints[i];
    SCOPED_TRACE(joint.name);
    const std::vector<int> before = positions();
    const short target = centidegreesFromMicroradians(before[i] + (joint.highest - before[i]) / 4);
    expectAnswer(request('J', joint.identifier), 'j', joint.identifier,
                 centidegreesFromMicroradians(before[i] + robot_.joints[i].error));
    expectAnswer(request('J', joint.identifier, target), 'j', joint.identifier, target);
    passFrames(kLongestWay);
    expectAnswer(request('J', joint.identifier), 'j', joint.identifier,
                 centidegreesFromMicroradians(microradiansFromCentidegrees(target) + robot_.joints[i].error));
    std::vector<int> expected = before;
    expected[i] = microradiansFromCentidegrees(target);
    EXPECT_EQ(positions(), expected);
  }
}

TEST_F(JointsTest, TargetBeyondTheLimitsIsClampedAndTheReplySaysSo) {
  expectAnswer(request('J', kHeadPan, 32767), 'j', kHeadPan, 8800);
  passFrames(kLongestWay);
  EXPECT_EQ(robot_.joint("head_pan").position, 1535890);
  expectAnswer(request('J', kNeckTilt, 100), 'j', kNeckTilt, 0);
}

TEST_F(JointsTest, IdentifierZeroSetsAllJointsWithinTheirLimits) {
  for (const int sign : {1, -1}) {
    expectAnswer(request('J', 0, sign * 1000), 'j', 0, sign * 1000);
    passFrames(kLongestWay);
    std::vector<int> posture(robot_.joints.size(), sign * 174533);
    clampPosture(robot_.model, posture.data());
    EXPECT_EQ(positions(), posture);
  }
  expectError(request('J', 0));
}

TEST_F(JointsTest, UnknownJointsAreRefused) {
  for (const int identifier : {5, 10, 14, 44, 50, 53, 255}) {
    for (const char letter : {'J', 'V', 'A'}) {
      expectError(request(letter, identifier));
      expectError(request(letter, identifier, 1));
    }
  }
}

TEST_F(JointsTest, JointMovesFromTheNextFrameOnWithinItsLimits) {
  const Joint& joint = robot_.model.joints[robot_model::findJointByName(robot_.model, "head_pan")];
  std::vector<int>& path = robot_.joint("head_pan").path;
  passFrames(50);
  const int before = path.back();
  path.clear();
  expectAnswer(request('J', kHeadPan, 4000), 'j', kHeadPan, 4000);
  passFrames(kLongestWay);
  EXPECT_GT(path[0], before);
  const int highest_step = joint.highest_speed / 125;
  const int highest_change = robot_model::defaultAcceleration(joint) / 125 / 125;
  for (size_t i = 2; i < path.size(); ++i) {
    const int step = path[i] - path[i - 1];
    ASSERT_LE(std::abs(step), highest_step);
    ASSERT_LE(std::abs(step - (path[i - 1] - path[i - 2])), highest_change);
  }
  EXPECT_EQ(path.back(), microradiansFromCentidegrees(4000));
}

// ------------------------------------------------------------------------------------------------ version 1: V and A

TEST_F(JointsTest, SpeedLimitIsReadSetAndKept) {
  expectAnswer(request('V', kNeckTilt), 'v', kNeckTilt, 18250);
  expectAnswer(request('V', kNeckTilt, 18251), 'v', kNeckTilt, 18250);  // the robot's own limit
  expectAnswer(request('V', kNeckTilt, 3000), 'v', kNeckTilt, 3000);
  expectAnswer(request('V', kNeckTilt), 'v', kNeckTilt, 3000);
  std::vector<int>& path = robot_.joint("neck_tilt").path;
  path.clear();
  answerTo(request('J', kNeckTilt, -7000));
  passFrames(kLongestWay);
  for (size_t i = 1; i < path.size(); ++i) {
    ASSERT_LE(std::abs(path[i] - path[i - 1]), microradiansFromCentidegrees(3000) / 125);
  }
}

TEST_F(JointsTest, LimitsWithWhichAJointCannotMoveAreRefused) {
  for (const char letter : {'V', 'A'}) {
    answerTo(request(letter, kNeckTilt, 3000));
    for (const int limit : {0, -1, -32768}) {
      expectError(request(letter, kNeckTilt, limit));
    }
    expectAnswer(request(letter, kNeckTilt), letter == 'V' ? 'v' : 'a', kNeckTilt, 3000);
  }
}

TEST_F(JointsTest, AccelerationLimitIsReadSetAndKept) {
  expectAnswer(request('A', kTailPan, 5000), 'a', kTailPan, 5000);
  expectAnswer(request('A', kTailPan), 'a', kTailPan, 5000);
  std::vector<int>& path = robot_.joint("tail_pan").path;
  path.clear();
  answerTo(request('J', kTailPan, 4000));
  passFrames(kLongestWay);
  for (size_t i = 2; i < path.size(); ++i) {
    ASSERT_LE(std::abs(path[i] - 2 * path[i - 1] + path[i - 2]), microradiansFromCentidegrees(5000) / 125 / 125);
  }
}

// --------------------------------------------------------------------------------------------------------------- jam

TEST_F(JointsTest, JammedJointIsHeldAndItsNextRequestIsAnsweredByAnError) {
  const std::tuple<const char*, int, int> first_and_last[] = {{"neck_tilt", kNeckTilt, -4000},
                                                              {"tail_tilt", kTailTilt, 4000}};
  for (const auto& [name, id, target] : first_and_last) {
    SCOPED_TRACE(name);
    FakeRobot::FakeJoint& joint = robot_.joint(name);
    const int before = centidegreesFromMicroradians(FakeRobot::measured(joint));
    joint.jammed = true;
    answerTo(request('J', id, target));
    answerTo(request('J', kTailPan, 3000));
    passFrames(kLongestWay);
    EXPECT_THAT(console_.str(), HasSubstr(std::string(name) + " is jammed"));
    EXPECT_EQ(joint.reference, FakeRobot::measured(joint)) << "its motor still pushes";
    EXPECT_EQ(robot_.joint("tail_pan").position, microradiansFromCentidegrees(3000));
    expectAnswer(request('J', kTailPan), 'j', kTailPan,
                 centidegreesFromMicroradians(FakeRobot::measured(robot_.joint("tail_pan"))));
    expectError(request('J', id));
    expectAnswer(request('J', id), 'j', id, before);
    answerTo(request('J', id, target / 2));
    passFrames(kLongestWay);
    joint.jammed = false;
    expectError(request('J', 0, 0));
    expectAnswer(request('J', 0, 0), 'j', 0, 0);
    passFrames(kLongestWay);
  }
  for (const auto& [name, id, target] : first_and_last) {
    robot_.joint(name).jammed = true;
    answerTo(request('J', id, target));
  }
  passFrames(kLongestWay);
  expectError(request('J', 0, 0));
  expectAnswer(request('J', 0, 0), 'j', 0, 0);
}

// --------------------------------------------------------------------------------------------------- simulated robot

class SimulatedJointsTest : public RCServerFixture {
 protected:
  void SetUp() override {
    boot(robot_);
    passFrames(50);
    client_ = connectServed();
  }

  simulated_ers7::SimulatedErs7 robot_;
  std::unique_ptr<TestClient> client_;
};

// Enough for a good part of any joint's range, and short because rendering camera images takes time.
constexpr unsigned kMotionOfOneSecond = 125;

TEST_F(SimulatedJointsTest, AllMoveAtOnceWithoutAFalseAlarm) {
  for (const int angle : {12000, -12000, 12000, 0}) {
    client_->send(request('J', 0, angle));
    ASSERT_EQ(awaitLetter(*client_), 'j');
    passFrames(kMotionOfOneSecond);
  }
  EXPECT_EQ(console_.str().find("jammed"), std::string::npos) << console_.str();
  EXPECT_EQ(console_.str().find("follow"), std::string::npos) << console_.str();
}

}  // namespace
