#include "walk/stance.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>

namespace aibo_driver::walk {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = 0.017453292519943295;
const Vector3d kLevel(0, 0, 9.81);

using Legs = std::array<LegAngles, kLegs>;

Legs legsAt(const LegAngles& front, const LegAngles& hind) {
  Legs legs;
  legs[robot_model::LEFT_FRONT_LEG] = legs[robot_model::RIGHT_FRONT_LEG] = front;
  legs[robot_model::LEFT_HIND_LEG] = legs[robot_model::RIGHT_HIND_LEG] = hind;
  return legs;
}

// Standing as in the motion SIT, and sitting as in it.
const Legs kStanding = legsAt({-23 * kDegree, 5 * kDegree, 44 * kDegree}, {26 * kDegree, 5 * kDegree, 57 * kDegree});
const Legs kSitting = legsAt({-35 * kDegree, 5 * kDegree, 15 * kDegree}, {60 * kDegree, 5 * kDegree, 115 * kDegree});

Vector3d accelerationAt(double roll, double pitch) {
  return Eigen::AngleAxisd(-roll, Vector3d::UnitX()) * Eigen::AngleAxisd(-pitch, Vector3d::UnitY()) * kLevel;
}

double pitchOf(const Stance& stance) {
  return std::asin(-stance.body.linear()(2, 0));
}

double heightOfFoot(const Stance& stance, const Legs& legs, Leg leg) {
  return (stance.body * footOf(leg, legs[leg])).z() - 0.013;
}

TEST(StanceTest, ARobotThatStandsIsLevelWithAllFeetOnTheFloor) {
  const Stance stance = estimateStance(kStanding, kLevel);
  EXPECT_NEAR(pitchOf(stance), 0, 2 * kDegree);
  EXPECT_NEAR(stance.body.translation().z(), 0.13, 0.02);
  EXPECT_EQ(stance.body.translation().head<2>(), Eigen::Vector2d(0, 0));
  EXPECT_THAT(stance.foot_on_floor, testing::Each(true));
}

TEST(StanceTest, ARobotThatSitsLeansBackAndHasItsFeetOnTheFloorToo) {
  const Stance stance = estimateStance(kSitting, accelerationAt(0, -25 * kDegree));
  EXPECT_NEAR(pitchOf(stance), -25 * kDegree, 1 * kDegree);
  EXPECT_THAT(stance.foot_on_floor, testing::Each(true));
  for (const Leg leg : {robot_model::LEFT_FRONT_LEG, robot_model::LEFT_HIND_LEG, robot_model::RIGHT_FRONT_LEG,
                        robot_model::RIGHT_HIND_LEG}) {
    EXPECT_NEAR(heightOfFoot(stance, kSitting, leg), 0, 1e-3) << leg;
  }
}

TEST(StanceTest, FollowsTheAccelerometerWhenNoFeetFitIt) {
  const Stance stance = estimateStance(kStanding, accelerationAt(30 * kDegree, 0));
  EXPECT_TRUE((stance.body.linear() * accelerationAt(30 * kDegree, 0)).isApprox(kLevel, 1e-9));
  EXPECT_GT(stance.body.linear()(0, 0), 0.999) << "x is ahead";
  double lowest = 1;
  for (const Leg leg : {robot_model::LEFT_FRONT_LEG, robot_model::LEFT_HIND_LEG, robot_model::RIGHT_FRONT_LEG,
                        robot_model::RIGHT_HIND_LEG}) {
    lowest = std::min(lowest, heightOfFoot(stance, kStanding, leg));
  }
  EXPECT_NEAR(lowest, 0, 1e-9) << "it does not hover";
}

TEST(StanceTest, BelievesTheFeetUpTo15DegreesFromTheAccelerometer) {
  for (const auto& [roll, believed] : {std::pair(14, 0), {16, 16}}) {
    const Stance stance = estimateStance(kStanding, accelerationAt(roll * kDegree, 0));
    EXPECT_NEAR(std::atan2(stance.body.linear()(2, 1), stance.body.linear()(2, 2)), believed * kDegree, 0.5 * kDegree);
  }
}

TEST(StanceTest, WhicheverFootIsLiftedTheRobotStandsOnTheOthers) {
  const Stance on_all_feet = estimateStance(kStanding, kLevel);
  for (std::size_t lifted = 0; lifted < kLegs; ++lifted) {
    Legs legs = kStanding;
    legs[lifted].knee += 60 * kDegree;
    const Stance stance = estimateStance(legs, accelerationAt(5 * kDegree, -5 * kDegree));
    std::array<bool, kLegs> expected = {true, true, true, true};
    expected[lifted] = false;
    EXPECT_EQ(stance.foot_on_floor, expected) << lifted;
    EXPECT_TRUE(stance.body.isApprox(on_all_feet.body, 1e-6)) << lifted;
  }
}

TEST(StanceTest, WithItsLegsSpreadTheRobotLiesOnItsBelly) {
  const LegAngles spread = {0, 88 * kDegree, 0};
  const Stance stance = estimateStance(legsAt(spread, spread), kLevel);
  EXPECT_NEAR(stance.body.translation().z(), 0.045, 1e-9);
  EXPECT_NEAR(pitchOf(stance), 0, 1e-9);
  EXPECT_THAT(stance.foot_on_floor, testing::Each(false));
}

TEST(StanceTest, IsFiniteWhateverIsMeasured) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const Vector3d& acceleration :
       {Vector3d(0, 0, 0), Vector3d(9.81, 0, 0), Vector3d(0, 0, -9.81), Vector3d(kNan, 0, 0)}) {
    EXPECT_TRUE(estimateStance(kStanding, acceleration).body.matrix().allFinite()) << acceleration.transpose();
  }
}

}  // namespace
}  // namespace aibo_driver::walk
