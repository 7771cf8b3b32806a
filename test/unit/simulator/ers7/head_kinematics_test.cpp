#include "simulator/ers7/body/head_kinematics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace simulated_ers7 {
namespace {

using Eigen::Vector3d;

const double kRightAngle = std::acos(0.0);

HeadAngles angles(double neck_tilt, double head_pan, double head_tilt) {
  HeadAngles head;
  head.neck_tilt = neck_tilt;
  head.head_pan = head_pan;
  head.head_tilt = head_tilt;
  return head;
}

void expectCamera(const HeadAngles& head, const Vector3d& position, const Vector3d& sight, const Vector3d& upwards) {
  const Eigen::Isometry3d camera = cameraInBody(head);
  EXPECT_TRUE(camera.translation().isApprox(position, 1e-9)) << camera.translation().transpose();
  EXPECT_TRUE((camera.linear() * Vector3d::UnitX()).isApprox(sight, 1e-9));
  EXPECT_TRUE((camera.linear() * Vector3d::UnitZ()).isApprox(upwards, 1e-9));
}

// The links: neck joint (67.5, 0, 19.5) mm, head joints 80 mm up the neck, camera 81.06 mm ahead and 14.6 mm below.

TEST(HeadKinematics, WithAllJointsAtZeroTheCameraLooksAhead) {
  expectCamera(angles(0, 0, 0), {0.0675 + 0.08106, 0, 0.0195 + 0.080 - 0.0146}, Vector3d::UnitX(), Vector3d::UnitZ());
}

TEST(HeadKinematics, PositivePanLooksLeft) {
  expectCamera(angles(0, kRightAngle, 0), {0.0675, 0.08106, 0.0195 + 0.080 - 0.0146}, Vector3d::UnitY(),
               Vector3d::UnitZ());
}

TEST(HeadKinematics, PositiveHeadTiltLooksUp) {
  expectCamera(angles(0, 0, kRightAngle), {0.0675 + 0.0146, 0, 0.0195 + 0.080 + 0.08106}, Vector3d::UnitZ(),
               -Vector3d::UnitX());
}

TEST(HeadKinematics, NegativeNeckTiltLowersTheHeadForwards) {
  expectCamera(angles(-kRightAngle, 0, 0), {0.0675 + 0.080 - 0.0146, 0, 0.0195 - 0.08106}, -Vector3d::UnitZ(),
               Vector3d::UnitX());
}

TEST(HeadKinematics, PanTurnsAboutTheTiltedNeck) {
  expectCamera(angles(-kRightAngle, kRightAngle, 0), {0.0675 + 0.080 - 0.0146, 0.08106, 0.0195}, Vector3d::UnitY(),
               Vector3d::UnitX());
}

}  // namespace
}  // namespace simulated_ers7
