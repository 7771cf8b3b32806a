#include "tools/teleop/joy_steering.h"

#include <gtest/gtest.h>

namespace teleop {
namespace {

using std::chrono::milliseconds;

class HeadSteeringTest : public ::testing::Test {
 protected:
  std::optional<PanTilt> steer(double pan, double tilt, milliseconds after = milliseconds(50)) {
    now_ += after;
    return head_.steer(PanTilt{pan, tilt}, now_);
  }

  HeadSteering head_;
  HeadSteering::TimePoint now_{std::chrono::hours(1)};
};

TEST_F(HeadSteeringTest, BeginsWhereTheHeadIs) {
  EXPECT_FALSE(HeadSteering().steer(PanTilt{1, 0}, now_)) << "it has not been measured yet";
  head_.measured({0.4, 0.2});
  EXPECT_DOUBLE_EQ(steer(1, -0.5)->pan, 0.4);
  EXPECT_DOUBLE_EQ(steer(1, -0.5)->pan, 0.45);
  EXPECT_DOUBLE_EQ(steer(1, -0.5)->tilt, 0.15);
  EXPECT_FALSE(head_.steer(std::nullopt, now_));
  head_.measured({-0.5, 0});
  EXPECT_DOUBLE_EQ(steer(1, 0)->pan, -0.5) << "others have moved it meanwhile";
}

TEST_F(HeadSteeringTest, KeepsToTheLimitsOfTheJoints) {
  head_.measured({1.5, 0.6});
  for (int i = 0; i < 10; ++i) {
    steer(1, 0.8);
  }
  EXPECT_NEAR(steer(1, 0.8)->pan, 1.53589, 1e-6);
  EXPECT_NEAR(steer(1, 0.8)->tilt, 0.785398, 1e-6);
}

TEST_F(HeadSteeringTest, DoesNotRunAheadOfASlowHeadOrJumpAfterAPause) {
  head_.measured({0.9, 0.1});
  for (int i = 0; i < 100; ++i) {
    steer(0.7, -0.5);
  }
  EXPECT_NEAR(steer(0.7, 0.5)->pan, 1.2, 1e-9);
  EXPECT_NEAR(steer(0.7, 0)->tilt, -0.175, 1e-9);
  head_.measured({0.95, 0.12});
  EXPECT_NEAR(steer(-0.7, 1, milliseconds(10000))->pan, 1.13, 1e-9);
}

}  // namespace
}  // namespace teleop
