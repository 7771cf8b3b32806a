#include "walk/stance.h"

#include <geometry_msgs/Vector3.h>
#include <gmock/gmock.h>

#include "node/body/body_pose.h"

namespace aibo_driver::node {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = 0.017453292519943295;
const Vector3d kLevel(0, 0, 9.81);

using Legs = std::array<walk::LegAngles, walk::kLegs>;

Legs legsAt(const walk::LegAngles& front, const walk::LegAngles& hind) {
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

double pitchOf(const walk::Stance& stance) {
  return std::asin(-stance.body.linear()(2, 0));
}

double heightOfFoot(const walk::Stance& stance, const Legs& legs, walk::Leg leg) {
  return (stance.body * walk::footOf(leg, legs[leg])).z() - 0.013;
}

TEST(StanceTest, ARobotThatStandsIsLevelWithAllFeetOnTheFloor) {
  const walk::Stance stance = walk::estimateStance(kStanding, kLevel);
  EXPECT_NEAR(pitchOf(stance), 0, 2 * kDegree);
  EXPECT_NEAR(stance.body.translation().z(), 0.13, 0.02);
  EXPECT_EQ(stance.body.translation().head<2>(), Eigen::Vector2d(0, 0));
  EXPECT_THAT(stance.foot_on_floor, testing::Each(true));
}

TEST(StanceTest, ARobotThatSitsLeansBackAndHasItsFeetOnTheFloorToo) {
  const walk::Stance stance = walk::estimateStance(kSitting, accelerationAt(0, -25 * kDegree));
  EXPECT_NEAR(pitchOf(stance), -25 * kDegree, 1 * kDegree);
  EXPECT_THAT(stance.foot_on_floor, testing::Each(true));
  for (const walk::Leg leg : {robot_model::LEFT_FRONT_LEG, robot_model::LEFT_HIND_LEG, robot_model::RIGHT_FRONT_LEG,
                              robot_model::RIGHT_HIND_LEG}) {
    EXPECT_NEAR(heightOfFoot(stance, kSitting, leg), 0, 1e-3) << leg;
  }
}

TEST(StanceTest, FollowsTheAccelerometerWhenNoFeetFitIt) {
  const walk::Stance stance = walk::estimateStance(kStanding, accelerationAt(30 * kDegree, 0));
  EXPECT_TRUE((stance.body.linear() * accelerationAt(30 * kDegree, 0)).isApprox(kLevel, 1e-9));
  EXPECT_GT(stance.body.linear()(0, 0), 0.999) << "x is ahead";
  double lowest = 1;
  for (const walk::Leg leg : {robot_model::LEFT_FRONT_LEG, robot_model::LEFT_HIND_LEG, robot_model::RIGHT_FRONT_LEG,
                              robot_model::RIGHT_HIND_LEG}) {
    lowest = std::min(lowest, heightOfFoot(stance, kStanding, leg));
  }
  EXPECT_NEAR(lowest, 0, 1e-9) << "it does not hover";
}

TEST(StanceTest, WhicheverFootIsLiftedTheRobotStandsOnTheOthers) {
  const walk::Stance on_all_feet = walk::estimateStance(kStanding, kLevel);
  for (std::size_t lifted = 0; lifted < walk::kLegs; ++lifted) {
    Legs legs = kStanding;
    legs[lifted].knee += 60 * kDegree;
    const walk::Stance stance = walk::estimateStance(legs, accelerationAt(5 * kDegree, -5 * kDegree));
    std::array<bool, walk::kLegs> expected = {true, true, true, true};
    expected[lifted] = false;
    EXPECT_EQ(stance.foot_on_floor, expected) << lifted;
    EXPECT_TRUE(stance.body.isApprox(on_all_feet.body, 1e-6)) << lifted;
  }
}

TEST(StanceTest, WithItsLegsSpreadTheRobotLiesOnItsBelly) {
  const walk::LegAngles spread = {0, 88 * kDegree, 0};
  const walk::Stance stance = walk::estimateStance(legsAt(spread, spread), kLevel);
  EXPECT_NEAR(stance.body.translation().z(), 0.045, 1e-9);
  EXPECT_NEAR(pitchOf(stance), 0, 1e-9);
  EXPECT_THAT(stance.foot_on_floor, testing::Each(false));
}

geometry_msgs::Vector3 vectorMessage(const Vector3d& vector) {
  geometry_msgs::Vector3 message;
  message.x = vector.x();
  message.y = vector.y();
  message.z = vector.z();
  return message;
}

TEST(BodyPoseTest, IsThatOfTheLegsAndOfTheSmoothedAcceleration) {
  const Vector3d tilted = accelerationAt(40 * kDegree, 20 * kDegree);
  const auto expect_pose_with = [](const BodyPose& pose, const Vector3d& acceleration) {
    const geometry_msgs::Transform transform = pose.above(kStanding);
    const walk::Stance stance = walk::estimateStance(kStanding, acceleration);
    const auto& turn = transform.rotation;
    EXPECT_TRUE(stance.body.linear().isApprox(Eigen::Quaterniond(turn.w, turn.x, turn.y, turn.z).matrix(), 1e-9));
    EXPECT_EQ(transform.translation.x, 0);
    EXPECT_EQ(transform.translation.y, 0);
    EXPECT_NEAR(transform.translation.z, stance.body.translation().z(), 1e-9);
  };
  BodyPose pose;
  EXPECT_FALSE(pose.isKnown());
  pose.accelerate(vectorMessage(kLevel), ros::Time(100));
  EXPECT_TRUE(pose.isKnown());
  expect_pose_with(pose, kLevel);
  pose.accelerate(vectorMessage(tilted), ros::Time(100.25));
  expect_pose_with(pose, kLevel + (1 - std::exp(-1)) * (tilted - kLevel));
  pose.accelerate(vectorMessage(tilted), ros::Time(90));
  expect_pose_with(pose, kLevel + (1 - std::exp(-1)) * (tilted - kLevel));
  pose.accelerate(vectorMessage(tilted), ros::Time(90.25));
  expect_pose_with(pose, kLevel + (1 - std::exp(-2)) * (tilted - kLevel));
}

TEST(BodyPoseTest, NamesTheJointsOfTheLegs) {
  EXPECT_EQ(legJointName(robot_model::LEFT_FRONT_LEG, 0), "left_front_rotator");
  EXPECT_EQ(legJointName(robot_model::LEFT_HIND_LEG, 1), "left_hind_elevator");
  EXPECT_EQ(legJointName(robot_model::RIGHT_FRONT_LEG, 2), "right_front_knee");
  EXPECT_EQ(legJointName(robot_model::RIGHT_HIND_LEG, 0), "right_hind_rotator");
}

TEST(StanceTest, IsFiniteWhateverIsMeasured) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const Vector3d& acceleration :
       {Vector3d(0, 0, 0), Vector3d(9.81, 0, 0), Vector3d(0, 0, -9.81), Vector3d(kNan, 0, 0)}) {
    EXPECT_TRUE(walk::estimateStance(kStanding, acceleration).body.matrix().allFinite()) << acceleration.transpose();
  }
}

}  // namespace
}  // namespace aibo_driver::node
