#include "rcserver/joints/JointControl.h"

#include <gtest/gtest.h>

#include <cstdlib>

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

// A joint fails, and another one that has failed follows again, just before the client goes.
TEST(JointControl, TheNextClientFindsTheRobotsOwnLimitsAndNoFaults) {
  JointControl joints(ers7());
  const int pan = findJointByName(ers7(), "head_pan");
  const int tail = findJointByName(ers7(), "tail_pan");
  joints.Planner().SetSpeedLimit(pan, 300000);
  joints.Failed(pan, JointWatch::LIMP);
  joints.Failed(tail, JointWatch::LIMP);
  const auto measure = [&joints, tail](unsigned begin) {
    for (unsigned frame = begin; frame <= begin + 2 * JointWatch::PATIENCE; frame += 4) {
      joints.Measured(tail, {100000, 100000, 0}, frame, true);
    }
  };
  measure(4);
  joints.ClientGone();
  EXPECT_EQ(joints.Planner().SpeedLimit(pan), ers7().joints[pan].highest_speed);
  EXPECT_EQ(joints.TakeFault(pan), JointWatch::FOLLOWS);
  EXPECT_EQ(joints.TakeFault(tail), JointWatch::FOLLOWS);
  EXPECT_FALSE(joints.TakeRecovery(tail));
  joints.Failed(tail, JointWatch::LIMP);
  joints.ClientGone();
  measure(1004);
  EXPECT_FALSE(joints.TakeRecovery(tail)) << "the next client does not know of the fault";
}

// What was counted for a joint before it failed does not count after it.
TEST(JointControl, AJointThatFailsTwiceIsReportedTwiceAndRecoversTwice) {
  JointControl joints(ers7());
  const int pan = findJointByName(ers7(), "head_pan");
  unsigned frame = 0;
  const auto measure = [&](unsigned frames, const JointReading& reading) {
    JointWatch::Verdict last = JointWatch::FOLLOWS;
    for (unsigned end = frame + frames; frame < end && last == JointWatch::FOLLOWS;) {
      frame += 4;
      last = joints.Measured(pan, reading, frame, true);
    }
    return last;
  };
  for (int time = 0; time < 2; ++time) {
    SCOPED_TRACE(time);
    EXPECT_EQ(measure(8, {-50000, -50000, 0}), JointWatch::FOLLOWS);
    EXPECT_EQ(measure(JointWatch::PATIENCE - 4, {-50000, 400000, FULL_DUTY}), JointWatch::FOLLOWS);
    EXPECT_EQ(measure(8, {-50000, 400000, FULL_DUTY}), JointWatch::JAMMED);
    EXPECT_EQ(joints.Planner().Target(pan), -50000) << "it is held where it is";
    EXPECT_EQ(joints.TakeFault(pan), JointWatch::JAMMED);
    EXPECT_EQ(joints.TakeFault(pan), JointWatch::FOLLOWS) << "once";
    EXPECT_EQ(measure(4 * JointWatch::PATIENCE, {-50000, -50000, 0}), JointWatch::FOLLOWS);
    EXPECT_FALSE(joints.TakeRecovery(pan)) << "it was only held";
    EXPECT_EQ(measure(2 * JointWatch::PATIENCE, {100000, 100000, 0}), JointWatch::FOLLOWS);
    EXPECT_TRUE(joints.TakeRecovery(pan));
    EXPECT_FALSE(joints.TakeRecovery(pan)) << "once";
  }
}

TEST(JointControl, AFaultTakesBackARecoveryThatNobodyHasHeardOf) {
  JointControl joints(ers7());
  const int pan = findJointByName(ers7(), "head_pan");
  joints.Failed(pan, JointWatch::LIMP);
  for (unsigned frame = 4; frame <= 2 * JointWatch::PATIENCE; frame += 4) {
    joints.Measured(pan, {100000, 100000, 0}, frame, true);
  }
  joints.Failed(pan, JointWatch::LIMP);
  EXPECT_FALSE(joints.TakeRecovery(pan));
}

// The motors are off for long, and the joint is moved by hand far from where it was commanded.
TEST(JointControl, TheTimeWithoutPowerIsNoFault) {
  JointControl joints(ers7());
  const int pan = findJointByName(ers7(), "head_pan");
  unsigned frame = 4;
  for (; frame <= 10 * JointWatch::PATIENCE; frame += 4) {
    joints.Measured(pan, {0, 400000, 0}, frame, false);
  }
  EXPECT_EQ(joints.Measured(pan, {0, 400000, 0}, frame, true), JointWatch::FOLLOWS);
}

TEST(JointControl, ACommandIsFoundAlsoWhenTheirNumberBeginsAgainAt0) {
  JointControl joints(ers7());
  const int pan = findJointByName(ers7(), "head_pan");
  joints.Stop(pan);
  bool commanded[robot_model::MAX_JOINTS];
  joints.FindCommandedSince(0xffffffffU, commanded);
  EXPECT_TRUE(commanded[pan]);
}

// ---------------------------------------------------------------------------------------------------------- stopping

class StoppedJointsTest : public ::testing::Test {
 protected:
  // Sends two joints far away, and waits until both are under way.
  void SetUp() override {
    MotionPlanner::JointTarget targets[] = {{pan_, 1500000}, {tail_, -700000}};
    joints_.SetTargets(targets, 2, 0);
    while (joints_.Planner().Speed(pan_) < 500000 || joints_.Planner().Speed(tail_) > -500000) {
      joints_.NextFrame();
    }
  }

  bool wasCommandedSince(unsigned number, int joint) const {
    bool commanded[robot_model::MAX_JOINTS];
    joints_.FindCommandedSince(number, commanded);
    return commanded[joint];
  }

  // Runs until a joint stands, and checks that it brakes as its limit says, and never turns back.
  void expectBrakes(int joint) {
    MotionPlanner& planner = joints_.Planner();
    const int limit = planner.AccelerationLimit(joint) / 125;  // change of speed in a frame
    while (planner.Speed(joint) != 0) {
      const int before = planner.Speed(joint);
      joints_.NextFrame();
      const int after = planner.Speed(joint);
      ASSERT_LT(std::abs(after), std::abs(before));
      ASSERT_LE(std::abs(after - before), limit);
      ASSERT_GE(static_cast<double>(after) * before, 0) << "it turned back";
    }
    EXPECT_EQ(planner.FramesLeft(joint), 0);
  }

  JointControl joints_{ers7()};
  const int pan_ = findJointByName(ers7(), "head_pan");
  const int tail_ = findJointByName(ers7(), "tail_pan");
};

TEST_F(StoppedJointsTest, AJointBrakesWithinItsLimitsAndTheOthersGoOn) {
  joints_.Stop(pan_);
  expectBrakes(pan_);
  while (joints_.AreMoving()) {
    joints_.NextFrame();
  }
  EXPECT_EQ(joints_.Planner().Position(tail_), -700000);
  EXPECT_LT(joints_.Planner().Position(pan_), 1000000);
}

TEST_F(StoppedJointsTest, AllJointsBrakeAtOnce) {
  joints_.StopAll();
  expectBrakes(pan_);
  while (joints_.AreMoving()) {
    joints_.NextFrame();
  }
  EXPECT_GT(joints_.Planner().Position(tail_), -700000);
}

TEST_F(StoppedJointsTest, CommandsAndStopsAreFoundByWhenTheyCame) {
  const unsigned before = joints_.NumberOfCommands();
  EXPECT_FALSE(wasCommandedSince(before, pan_));
  EXPECT_TRUE(wasCommandedSince(before - 1, pan_));
  joints_.Stop(pan_);
  EXPECT_TRUE(wasCommandedSince(before, pan_));
  EXPECT_FALSE(wasCommandedSince(before, tail_));
  const unsigned later = joints_.NumberOfCommands();
  joints_.StopAll();
  EXPECT_TRUE(wasCommandedSince(later, pan_));
  EXPECT_TRUE(wasCommandedSince(later, tail_));
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

// -------------------------------------------------------------------------------------------------- JointRecovery

class JointRecoveryTest : public ::testing::Test {
 protected:
  JointRecoveryTest() {
    recovery_.Reset(0, 0);
    recovery_.Await();
  }

  // Looks at the same reading for a number of frames.
  bool look(unsigned frames, int position, int reference) {
    for (unsigned passed = 0; passed < frames; passed += kPeriod) {
      frame_ += kPeriod;
      if (recovery_.Look({position, reference, 0}, frame_)) {
        return true;
      }
    }
    return false;
  }

  JointRecovery recovery_;
  unsigned frame_ = 0;
};

TEST_F(JointRecoveryTest, JointThatHasFollowedACommandForHalfASecondHasRecovered) {
  EXPECT_FALSE(look(JointWatch::PATIENCE - kPeriod, JointWatch::MOVEMENT, JointWatch::MOVEMENT));
  EXPECT_TRUE(look(2 * kPeriod, JointWatch::MOVEMENT, JointWatch::MOVEMENT));
  EXPECT_FALSE(look(10 * JointWatch::PATIENCE, JointWatch::MOVEMENT, JointWatch::MOVEMENT)) << "reported once";
}

TEST_F(JointRecoveryTest, JointThatIsHeldHasNotRecoveredHoweverLongItRests) {
  EXPECT_FALSE(look(100 * JointWatch::PATIENCE, 0, 0));
}

TEST_F(JointRecoveryTest, JointThatIsMovedByHandHasNotRecovered) {
  EXPECT_FALSE(look(10 * JointWatch::PATIENCE, JointWatch::TOLERANCE, 0));
}

TEST_F(JointRecoveryTest, JointThatIsCommandedAndDoesNotMoveHasNotRecovered) {
  EXPECT_FALSE(look(10 * JointWatch::PATIENCE, 0, JointWatch::TOLERANCE));
}

TEST_F(JointRecoveryTest, JointThatStaysFarBehindHasNotRecovered) {
  EXPECT_FALSE(look(10 * JointWatch::PATIENCE, JointWatch::MOVEMENT, kFar + JointWatch::MOVEMENT));
}

TEST_F(JointRecoveryTest, HalfASecondBeginsAgainWhenItFallsBehind) {
  EXPECT_FALSE(look(JointWatch::PATIENCE - kPeriod, kFar, kFar));
  EXPECT_FALSE(look(kPeriod, kFar, 3 * kFar));
  EXPECT_FALSE(look(JointWatch::PATIENCE - kPeriod, kFar, kFar));
  EXPECT_TRUE(look(2 * kPeriod, kFar, kFar));
}

TEST_F(JointRecoveryTest, JointThatIsHeldElsewhereHasToMoveFromThere) {
  recovery_.Reset(kFar, frame_);
  EXPECT_FALSE(look(10 * JointWatch::PATIENCE, kFar, kFar)) << "switching the motors on moves nothing";
  EXPECT_TRUE(look(2 * JointWatch::PATIENCE, 0, 0));
}

TEST_F(JointRecoveryTest, JointWithoutAFaultDoesNotRecover) {
  recovery_.Forget();
  EXPECT_FALSE(look(10 * JointWatch::PATIENCE, kFar, kFar));
}

}  // namespace
