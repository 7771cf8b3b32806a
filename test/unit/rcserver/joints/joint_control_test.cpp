#include "rcserver/joints/JointControl.h"

#include <gtest/gtest.h>

namespace {

const robot_model::RobotModel& ers7() {
  return *robot_model::findRobotModel("ERS-7");
}

TEST(JointControl, JointsStopWithTheRobotsOwnLimitsWhenTheClientGoes) {
  JointControl joints(ers7());
  const int pan = findJointByName(ers7(), "head_pan");
  joints.Planner().SetAccelerationLimit(pan, 300000);
  MotionPlanner::JointTarget target = {pan, 1500000};
  joints.SetTargets(&target, 1, 0);
  while (joints.Planner().Speed(pan) < 500000) {
    joints.NextFrame();
  }
  const int left_at = joints.Planner().Position(pan);
  joints.ClientGone();
  while (joints.AreMoving()) {
    joints.NextFrame();
  }
  EXPECT_LT(joints.Planner().Position(pan), left_at + 20000) << "with its own limit, it would be 0.4 rad";
  EXPECT_EQ(joints.Planner().AccelerationLimit(pan), defaultAcceleration(ers7().joints[pan]));
}

// ---------------------------------------------------------------------------------------------------- JointWatch

constexpr int kFar = 2 * JointWatch::TOLERANCE;
constexpr unsigned kPeriod = 4;

class JointWatchTest : public ::testing::Test {
 protected:
  // Looks at readings for a number of frames; the position grows by `step` from one to the next.
  JointWatch::Verdict look(unsigned frames, int reference, int duty, int step = 0) {
    JointWatch::Verdict verdict = JointWatch::FOLLOWS;
    for (unsigned passed = 0; passed < frames && verdict == JointWatch::FOLLOWS; passed += kPeriod) {
      frame_ += kPeriod;
      position_ += step;
      verdict = watch_.Look({position_, reference, duty}, frame_);
    }
    return verdict;
  }

  JointWatch watch_;
  unsigned frame_ = 0;
  int position_ = 0;
};

TEST_F(JointWatchTest, JointThatPushesInVainForHalfASecondIsJammed) {
  EXPECT_EQ(look(JointWatch::PATIENCE - kPeriod, kFar, 512), JointWatch::FOLLOWS);
  EXPECT_EQ(look(2 * kPeriod, kFar, 512), JointWatch::JAMMED);
}

TEST_F(JointWatchTest, DirectionDoesNotMatter) {
  EXPECT_EQ(look(2 * JointWatch::PATIENCE, -kFar, -512), JointWatch::JAMMED);
}

TEST_F(JointWatchTest, JointThatDoesNotPushDoesNotFollow) {
  EXPECT_EQ(look(2 * JointWatch::PATIENCE, kFar, 0), JointWatch::UNCONTROLLABLE);
}

TEST_F(JointWatchTest, JointThatLagsBehindButMovesFollows) {
  EXPECT_EQ(look(10 * JointWatch::PATIENCE, 1000 * kFar, 512, JointWatch::MOVEMENT / 10), JointWatch::FOLLOWS);
}

TEST_F(JointWatchTest, JointThatHangsALittleUnderItsLoadFollows) {
  EXPECT_EQ(look(10 * JointWatch::PATIENCE, JointWatch::TOLERANCE, 512), JointWatch::FOLLOWS);
}

TEST_F(JointWatchTest, FaultIsReportedAgainOnlyAfterAnotherHalfSecond) {
  ASSERT_EQ(look(2 * JointWatch::PATIENCE, kFar, 512), JointWatch::JAMMED);
  EXPECT_EQ(look(JointWatch::PATIENCE - kPeriod, kFar, 512), JointWatch::FOLLOWS);
  EXPECT_EQ(look(2 * kPeriod, kFar, 512), JointWatch::JAMMED);
}

TEST_F(JointWatchTest, RestCountsAsFollowingHoweverLongItLasts) {
  EXPECT_EQ(look(10 * JointWatch::PATIENCE, 0, 0), JointWatch::FOLLOWS);
  EXPECT_EQ(look(JointWatch::PATIENCE - kPeriod, kFar, 512), JointWatch::FOLLOWS);
}

}  // namespace
