#include "simulator/ers7/body/head_kinematics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace simulated_ers7 {
namespace {

using Eigen::Vector3d;

// The links: neck joint (67.5, 0, 19.5) mm, head joints 80 mm up the neck, camera 81.06 mm ahead and 14.6 mm below.
TEST(HeadKinematics, PutTheCameraWhereTheLinksEnd) {
  const double right_angle = std::acos(0.0);
  const Vector3d x = Vector3d::UnitX();
  const Vector3d y = Vector3d::UnitY();
  const Vector3d z = Vector3d::UnitZ();
  const struct {
    const char* name;
    double neck_tilt, head_pan, head_tilt;  // in right angles
    Vector3d position, sight, upwards;
  } rows[] = {
      {"ahead", 0, 0, 0, {0.0675 + 0.08106, 0, 0.0195 + 0.080 - 0.0146}, x, z},
      {"positive pan looks left", 0, 1, 0, {0.0675, 0.08106, 0.0195 + 0.080 - 0.0146}, y, z},
      {"positive tilt looks up", 0, 0, 1, {0.0675 + 0.0146, 0, 0.0195 + 0.080 + 0.08106}, z, -x},
      {"negative neck tilt lowers", -1, 0, 0, {0.0675 + 0.080 - 0.0146, 0, 0.0195 - 0.08106}, -z, x},
      {"pan turns about the tilted neck", -1, 1, 0, {0.0675 + 0.080 - 0.0146, 0.08106, 0.0195}, y, x},
  };
  for (const auto& row : rows) {
    HeadAngles head;
    head.neck_tilt = row.neck_tilt * right_angle;
    head.head_pan = row.head_pan * right_angle;
    head.head_tilt = row.head_tilt * right_angle;
    const Eigen::Isometry3d camera = cameraInBody(head);
    EXPECT_TRUE(camera.translation().isApprox(row.position, 1e-9)) << row.name;
    EXPECT_TRUE((camera.linear() * x).isApprox(row.sight, 1e-9)) << row.name;
    EXPECT_TRUE((camera.linear() * z).isApprox(row.upwards, 1e-9)) << row.name;
  }
}

}  // namespace
}  // namespace simulated_ers7
