#include "simulator/ers7/body/joints.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace simulated_ers7 {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

const robot_model::RobotModel& ers7() {
  return *robot_model::findRobotModel("ERS-7");
}

/// Depth of a foot's lower end below the leg's joint, and its distance in front of it, in metres; lengths from
/// Tekkotsu's table, x ahead, z up.
Vector3d foot(const Joints& joints, const std::string& leg, const Vector3d& knee, const Vector3d& ball) {
  const double rotator = joints.named(leg + "_rotator").position() / 1e6;
  const double bend = joints.named(leg + "_knee").position() / 1e6 * (knee.x() > 0 ? 1 : -1);
  const auto forward = [](double angle) { return AngleAxisd(-angle, Vector3d::UnitY()); };
  return forward(rotator) * (knee + forward(bend) * ball) - 0.013 * Vector3d::UnitZ();
}

TEST(Joints, StartInAnAllowedPosture) {
  const Joints joints(ers7(), 1);
  std::vector<int> posture;
  for (const Joint& joint : joints.all()) {
    posture.push_back(static_cast<int>(joint.position()));
  }
  std::vector<int> allowed = posture;
  robot_model::clampPosture(ers7(), allowed.data());
  EXPECT_EQ(posture, allowed);
}

TEST(Joints, StartWithAllFeetOnTheFloor) {
  const Joints joints(ers7(), 1);
  for (const char* leg : {"left_front", "right_front"}) {
    const Vector3d place = foot(joints, leg, {0.009, 0, -0.0695}, {-0.00503, 0, -0.06524});
    EXPECT_NEAR(place.z(), -kStandingHeight, 0.001) << leg;
    EXPECT_NEAR(place.x(), 0, 0.002) << leg;
  }
  for (const char* leg : {"left_hind", "right_hind"}) {
    const Vector3d place = foot(joints, leg, {-0.009, 0, -0.0695}, {0.013529, 0, -0.06628});
    EXPECT_NEAR(place.z(), -kStandingHeight, 0.001) << leg;
    EXPECT_NEAR(place.x(), 0, 0.002) << leg;
  }
}

TEST(Joints, GiveTheAnglesOfTheHead) {
  Joints joints(ers7(), 1);
  joints.setPower(true);
  for (const char* name : {"neck_tilt", "head_pan", "head_tilt"}) {
    Joint& joint = joints.named(name);
    joint.enableGain();
    ASSERT_EQ(joint.setGains(joint.model().gains), oSUCCESS);
  }
  joints.named("neck_tilt").command(-700000);
  joints.named("head_pan").command(300000);
  joints.named("head_tilt").command(200000);
  for (int i = 0; i < 100; ++i) {
    joints.passFrame();
  }
  EXPECT_NEAR(joints.head().neck_tilt, -0.7, 1e-6);
  EXPECT_NEAR(joints.head().head_pan, 0.3, 1e-6);
  EXPECT_NEAR(joints.head().head_tilt, 0.2, 1e-6);
}

TEST(Joints, HaveEncoderErrorsOfUpToATwentiethOfADegree) {
  Joints joints(ers7(), 1);
  int most = 0;
  for (int i = 0; i < 100; ++i) {
    joints.passFrame();
    for (const Joint& joint : joints.all()) {
      most = std::max(most, std::abs(joint.readings().back().value - static_cast<int>(joint.position())));
    }
  }
  EXPECT_LE(most, 873);
  EXPECT_GT(most, 800);
}

TEST(Joints, NameAnUnknownJointInTheirError) {
  Joints joints(ers7(), 1);
  try {
    joints.named("left_wing");
    FAIL() << "no error";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "the ERS-7 has no joint \"left_wing\"");
  }
}

}  // namespace
}  // namespace simulated_ers7
