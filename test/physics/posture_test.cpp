#include <gmock/gmock.h>

#include "trial.h"

namespace {

using physics::World;

namespace version2 = protocol::version2;
using version2::Posture;

constexpr double kDegree = 3.14159265358979323846 / 180;

/// Lets the robot take a posture. It must not tip over on the way.
void take(physics::Bench& bench, Posture posture) {
  SCOPED_TRACE(postureName(posture));
  const size_t before = bench.ends().size();
  bench.take(posture);
  double highest_tilt = 0;
  int frames_afterwards = 0;
  for (int i = 0; i < 20 * 125 && frames_afterwards < 125; ++i) {
    bench.passFrame();
    highest_tilt = std::max(highest_tilt, bench.robot().tilt());
    frames_afterwards += bench.ends().size() > before ? 1 : 0;
  }
  EXPECT_LT(highest_tilt, 50 * kDegree);
  ASSERT_GT(bench.ends().size(), before) << "it does not arrive: " << testing::PrintToString(bench.errors());
  const physics::End& end = bench.ends().back();
  EXPECT_EQ(end.what, version2::ENDED_POSTURE);
  EXPECT_EQ(end.how, version2::END_DONE) << end.reason;
  EXPECT_EQ(end.name, postureName(posture));
}

class Postures : public ::testing::TestWithParam<World> {};

TEST_P(Postures, CanBeTakenFromEachOther) {
  physics::Bench bench(GetParam());
  for (const Posture posture :
       {version2::POSTURE_STAND, version2::POSTURE_SIT, version2::POSTURE_STAND, version2::POSTURE_REST,
        version2::POSTURE_SIT, version2::POSTURE_REST, version2::POSTURE_STAND}) {
    if (!bench.robot().motorsPull()) {
      bench.switchMotors(true);
    }
    take(bench, posture);
    EXPECT_EQ(bench.robot().motorsPull(), posture != version2::POSTURE_REST);
    if (posture == version2::POSTURE_STAND) {
      EXPECT_FALSE(bench.robot().bodyTouchesFloor());
      EXPECT_LT(bench.robot().tilt(), 5 * kDegree);
      for (int leg = 0; leg < robot_model::NUMBER_OF_LEGS; ++leg) {
        EXPECT_TRUE(bench.robot().touchesFloor(static_cast<robot_model::Leg>(leg))) << leg;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(With, Postures, ::testing::Values(World{1.5, 0.8}, World{0.7, 0.4}, World{3, 1}));

void expectRise(const physics::Rise& rise) {
  EXPECT_TRUE(rise.stands) << rise.reason;
  EXPECT_LT(rise.seconds, 10);
  EXPECT_LT(rise.at_full_duty, 2);
  EXPECT_EQ(rise.beyond_limits, 0);
}

TEST(FallenRobot, StandsUp) {
  const std::vector<World> worlds = physics::sampleOfWorlds(36, 1);  // those of scripts/physics
  for (const std::size_t i : {0, 9, 18, 27}) {
    const World& world = worlds[i];
    SCOPED_TRACE(describe(world));
    for (const auto lying : {physics::Lying::kOnLeftSide, physics::Lying::kOnRightSide, physics::Lying::kOnBack}) {
      SCOPED_TRACE(static_cast<int>(lying));
      expectRise(physics::standUp(world, lying));
    }
  }
}

TEST(RobotWithBentLegs, StandsUp) {
  for (const double torque : {1.5, 0.7}) {
    World world;
    world.stall_torque = torque;
    for (unsigned seed = 0; seed < 6; ++seed) {
      SCOPED_TRACE(seed);
      expectRise(physics::standUpFromAnyPosture(world, seed));
    }
  }
}

class Fall : public ::testing::Test {
 protected:
  void walk() {
    bench_.steer({0.08, 0, 0});
    pass(bench_, 4);
    ASSERT_EQ(bench_.step().state, version2::WALK_STATE_WALKS);
  }

  physics::Bench bench_;
};

// A robot that is pushed over stops walking at once, and after a second its legs do not push against anything any more.
TEST_F(Fall, EndsTheWalkAndLetsTheLegsGoSoft) {
  walk();
  bench_.robot().push({0, 16, 0});
  for (int i = 0; i < 500 && bench_.robot().tilt() < 1; ++i) {
    bench_.passFrame();
  }
  bench_.robot().push({0, 0, 0});
  const physics::End end = bench_.awaitEnd(version2::ENDED_WALK, 4);
  EXPECT_GT(bench_.robot().tilt(), 1);
  EXPECT_EQ(end.how, version2::END_FELL);
  EXPECT_THAT(end.reason, testing::HasSubstr("the robot lies on its"));
  EXPECT_TRUE(bench_.robot().motorsPull());
  pass(bench_, 1.2);
  EXPECT_FALSE(bench_.robot().motorsPull());
  EXPECT_EQ(bench_.step().state, version2::WALK_STATE_NONE);
}

TEST_F(Fall, IsNotSeenInAPushThatTheRobotWithstands) {
  walk();
  bench_.robot().push({0, 3, 0});
  pass(bench_, 0.3);
  bench_.robot().push({0, 0, 0});
  pass(bench_, 3);
  EXPECT_THAT(bench_.ends(), testing::IsEmpty());
  EXPECT_LT(bench_.robot().tilt(), 0.2);
}

}  // namespace
