#include "simulator/ers7/body/joints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace simulated_ers7 {
namespace {

const robot_model::RobotModel& ers7() {
  return *robot_model::findRobotModel("ERS-7");
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

}  // namespace
}  // namespace simulated_ers7
