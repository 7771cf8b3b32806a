// Joints in version 1, and the motors at boot.

#include "protocol/units.h"
#include "rcserver_fixture.h"

namespace {

using protocol::centidegreesFromMicroradians;
using protocol::microradiansFromCentidegrees;
using robot_model::Joint;
using ::testing::Each;
using ::testing::HasSubstr;

constexpr int kNeckTilt = 1;
constexpr int kHeadPan = 2;
constexpr int kTailPan = 51;
constexpr int kTailTilt = 52;

// More than enough for any motion with the standard limits.
constexpr unsigned kLongestWay = 500;

class JointsTest : public Version1Fixture {};

TEST_F(JointsTest, GainsOfTheTableGoOnOnlyAfterThePresentPositionsWereCommanded) {
  machine_.reset();
  for (FakeRobot::FakeJoint& joint : robot_.joints) {
    joint.gain = false;
    joint.gains = {};
    joint.reference = 12345;  // an earlier program's last command
    joint.path.clear();
  }
  start();
  for (size_t i = 0; i < robot_.joints.size(); ++i) {
    const FakeRobot::FakeJoint& joint = robot_.joints[i];
    const robot_model::PidGains& gains = robot_.model.joints[i].gains;
    EXPECT_TRUE(joint.gain);
    EXPECT_EQ(joint.error_when_gain_went_on, 0);
    EXPECT_THAT(joint.path, Each(joint.path.front()));
    EXPECT_EQ(std::memcmp(&joint.gains, &gains, sizeof(gains)), 0);
  }
  EXPECT_TRUE(robot_.powered);
}

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

TEST_F(JointsTest, LimitsAreReadAndSetAndTargetsKeepToThem) {
  expectAnswer(request('J', kHeadPan, 32767), 'j', kHeadPan, 8800);
  expectAnswer(request('V', kNeckTilt), 'v', kNeckTilt, 18250);
  expectAnswer(request('V', kNeckTilt, 18251), 'v', kNeckTilt, 18250);  // the robot's own limit
  expectAnswer(request('V', kNeckTilt, 3000), 'v', kNeckTilt, 3000);
  expectAnswer(request('V', kNeckTilt), 'v', kNeckTilt, 3000);
  expectAnswer(request('A', kTailPan, 5000), 'a', kTailPan, 5000);
  expectAnswer(request('A', kTailPan), 'a', kTailPan, 5000);
}

TEST_F(JointsTest, JammedJointIsHeldAndItsNextRequestIsAnsweredByAnError) {
  for (const bool by_name : {true, false}) {
    FakeRobot::FakeJoint& joint = robot_.joint("tail_tilt");
    joint.jammed = true;
    answerTo(request('J', kTailTilt, by_name ? 4000 : 3000));
    answerTo(request('J', kTailPan, 3000));
    passFrames(kLongestWay);
    EXPECT_THAT(console_.str(), HasSubstr("tail_tilt is jammed"));
    EXPECT_EQ(joint.reference, FakeRobot::measured(joint)) << "its motor still pushes";
    EXPECT_EQ(robot_.joint("tail_pan").position, microradiansFromCentidegrees(3000));
    EXPECT_EQ(answerTo(request('J', kTailPan)).letter, 'j') << "another joint";
    const std::string next = by_name ? request('J', kTailTilt) : request('J', 0, 0);
    expectError(next);
    EXPECT_EQ(answerTo(next).letter, 'j') << "once";
    joint.jammed = false;
  }
}

}  // namespace
