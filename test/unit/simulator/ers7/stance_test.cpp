// The stance of the robot on its legs.
#include "simulator/ers7/body/stance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "robot_model/robot_model.h"
#include "simulator/ers7/body/joints.h"

namespace simulated_ers7 {
namespace {

const double kOneDegree = std::acos(-1.0) / 180;

/// All legs straight down: the feet are then 0.1348 m under the shoulders in front, 0.1358 m behind.
const std::array<LegAngles, kLegs> kStraight = {};

/// The pitch of the body, in radian; positive if the nose points up.
double pitch(const Stance& stance) {
  return std::asin(stance.body.linear()(2, 0));
}

TEST(StanceTest, AtRestTheRobotStandsLevelOnAllFourAtItsStandingHeight) {
  const Joints joints(*robot_model::findRobotModel("ERS-7"), 1);
  const Stance stance = standOn(joints.legs());
  EXPECT_NEAR(stance.body.translation().z(), kStandingHeight, 0.001);
  EXPECT_NEAR(pitch(stance), 0, 0.01);
  EXPECT_EQ(stance.paw_down, (std::array<bool, kLegs>{true, true, true, true}));
}

TEST(StanceTest, WithItsLegsSpreadTheRobotLiesOnItsBelly) {
  auto legs = kStraight;
  for (LegAngles& leg : legs) {
    leg.elevator = 88 * kOneDegree;
  }
  const Stance stance = standOn(legs);
  EXPECT_NEAR(stance.body.translation().z(), 0.045, 0.001);
  EXPECT_NEAR(pitch(stance), 0, 1e-6);
  EXPECT_EQ(stance.paw_down, (std::array<bool, kLegs>{false, false, false, false}));
}

}  // namespace
}  // namespace simulated_ers7
