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

}  // namespace
