#include "rcserver/walk/WalkedVelocity.h"

#include <gmock/gmock.h>

#include <array>

namespace {

using robot_model::LegAngles;

constexpr bool kAllPaws[] = {true, true, true, true};
constexpr bool kNoPaws[] = {false, false, false, false};
constexpr double kSeconds = 0.032;

using Legs = std::array<LegAngles, robot_model::NUMBER_OF_LEGS>;

class WalkedVelocityTest : public ::testing::Test {
 protected:
  WalkedVelocityTest() { walked_.Begin(); }

  void report(const Legs& legs, const bool* paws, unsigned frames = 4, double unseen = 0) {
    frame_ += frames;
    walked_.Measured(legs.data(), paws, frame_, unseen);
  }

  static Legs swungBy(double rotator) {
    Legs legs{};
    for (LegAngles& leg : legs) {
      leg.rotator = rotator;
    }
    return legs;
  }

  /// Of the shoulders over the floor: a leg whose foot rolls turns about the point where the foot touches the floor.
  static double heightOf(const Legs& legs) {
    return robot_model::FOOT_RADIUS - findFoot(robot_model::LEFT_FRONT_LEG, legs[0]).z;
  }

  WalkedVelocity walked_;
  unsigned frame_ = 0;
};

TEST_F(WalkedVelocityTest, IsThatOfABodyOnFeetThatRoll) {
  constexpr double kSwing = 0.02;
  report(swungBy(kSwing / 2), kAllPaws);
  report(swungBy(-kSwing / 2), kAllPaws);
  EXPECT_NEAR(walked_.Now().forward, heightOf(swungBy(0)) * kSwing / kSeconds, 1e-3);
  EXPECT_NEAR(walked_.Now().left, 0, 1e-9);
  EXPECT_NEAR(walked_.Now().turn, 0, 1e-9);
}

TEST_F(WalkedVelocityTest, WithoutPawsTheLowerPairCountsAndTheLastVelocityWhileThePairsChange) {
  Legs legs = swungBy(0);
  legs[robot_model::LEFT_HIND_LEG].knee = legs[robot_model::RIGHT_FRONT_LEG].knee = 1;  // it lifts these two
  report(legs, kNoPaws);
  legs[robot_model::LEFT_FRONT_LEG].rotator = legs[robot_model::RIGHT_HIND_LEG].rotator = -0.01;
  legs[robot_model::LEFT_HIND_LEG].rotator = legs[robot_model::RIGHT_FRONT_LEG].rotator = 0.1;
  report(legs, kNoPaws);
  const double speed = walked_.Now().forward;
  EXPECT_NEAR(speed, heightOf(swungBy(0)) * 0.01 / kSeconds, 1e-3);
  legs = swungBy(0.2);
  legs[robot_model::LEFT_FRONT_LEG].knee = legs[robot_model::RIGHT_HIND_LEG].knee = 1;
  report(legs, kNoPaws, 4, 0.1);
  EXPECT_EQ(walked_.Now().forward, speed) << "with nothing added to it";
}

TEST_F(WalkedVelocityTest, IsTheAverageOfTheReportsSinceTheLastTime) {
  report(swungBy(0.01), kAllPaws);
  report(swungBy(0), kAllPaws);
  report(swungBy(0), kAllPaws);
  EXPECT_NEAR(walked_.Take(true).forward, heightOf(swungBy(0)) * 0.01 / kSeconds / 2, 1e-3);
  EXPECT_EQ(walked_.Take(true).forward, 0) << "the last report's";
  EXPECT_TRUE(walked_.Take(false).isZero());
}

}  // namespace
