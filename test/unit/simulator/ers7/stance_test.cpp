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

TEST(StanceTest, FeetAreAtTheEndsOfTheLegsLinks) {
  // By hand: 0.065 + 0.009 - 0.00503, 0.0625 + 0.0047, -0.0695 - 0.06524; mirrored on the right.
  EXPECT_TRUE(footInBody(robot_model::LEFT_FRONT_LEG, {}).isApprox(Eigen::Vector3d(0.06897, 0.0672, -0.13474), 1e-9));
  EXPECT_TRUE(
      footInBody(robot_model::RIGHT_HIND_LEG, {}).isApprox(Eigen::Vector3d(-0.060471, -0.0672, -0.13578), 1e-9));
  LegAngles forward{};
  forward.rotator = 90 * kOneDegree;
  EXPECT_NEAR(footInBody(robot_model::LEFT_FRONT_LEG, forward).x(), 0.065 + 0.13474, 1e-9);
  LegAngles aside{};
  aside.elevator = 90 * kOneDegree;
  EXPECT_NEAR(footInBody(robot_model::RIGHT_FRONT_LEG, aside).y(), -(0.0625 + 0.13474), 1e-9);
  LegAngles bent{};
  bent.knee = 90 * kOneDegree;
  EXPECT_NEAR(footInBody(robot_model::LEFT_FRONT_LEG, bent).x(), 0.065 + 0.009 + 0.06524, 1e-9)
      << "front legs bend forward";
  EXPECT_NEAR(footInBody(robot_model::LEFT_HIND_LEG, bent).x(), -0.065 - 0.009 - 0.06628, 1e-9)
      << "hind legs bend backward";
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
