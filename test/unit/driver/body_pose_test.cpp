#include "node/body/body_pose.h"

#include <gtest/gtest.h>

#include <cmath>

namespace aibo_driver::node {
namespace {

using Eigen::Vector3d;

geometry_msgs::Vector3 vectorMessage(const Vector3d& vector) {
  geometry_msgs::Vector3 message;
  message.x = vector.x();
  message.y = vector.y();
  message.z = vector.z();
  return message;
}

TEST(BodyPoseTest, IsThatOfTheLegsAndOfTheSmoothedAcceleration) {
  const std::array<walk::LegAngles, walk::kLegs> legs{};
  const Vector3d level(0, 0, 9.81);
  const Vector3d tilted(-3.4, 5.9, 7.1);
  const auto expect_pose_with = [&legs](const BodyPose& pose, const Vector3d& acceleration) {
    const geometry_msgs::Transform transform = pose.above(legs);
    const walk::Stance stance = walk::estimateStance(legs, acceleration);
    const auto& turn = transform.rotation;
    EXPECT_TRUE(stance.body.linear().isApprox(Eigen::Quaterniond(turn.w, turn.x, turn.y, turn.z).matrix(), 1e-9));
    EXPECT_EQ(transform.translation.x, 0);
    EXPECT_EQ(transform.translation.y, 0);
    EXPECT_NEAR(transform.translation.z, stance.body.translation().z(), 1e-9);
  };
  BodyPose pose;
  EXPECT_FALSE(pose.isKnown());
  pose.accelerate(vectorMessage(level), ros::Time(100));
  EXPECT_TRUE(pose.isKnown());
  expect_pose_with(pose, level);
  pose.accelerate(vectorMessage(tilted), ros::Time(100.25));
  expect_pose_with(pose, level + (1 - std::exp(-1)) * (tilted - level));
  pose.accelerate(vectorMessage(tilted), ros::Time(90));
  expect_pose_with(pose, level + (1 - std::exp(-1)) * (tilted - level));
  pose.accelerate(vectorMessage(tilted), ros::Time(90.25));
  expect_pose_with(pose, level + (1 - std::exp(-2)) * (tilted - level));
}

}  // namespace
}  // namespace aibo_driver::node
