#include <gmock/gmock.h>

#include "trial.h"

namespace {

using physics::World;

namespace version2 = protocol::version2;
using version2::Posture;

constexpr double kDegree = 3.14159265358979323846 / 180;

/// A robot that takes postures. It must not tip over on the way.
class PostureTaker {
 public:
  explicit PostureTaker(const World& world = World()) : bench_(world) {}

  void take(Posture posture) {
    bench_.take(posture);
    awaitArrival(posture);
  }

  void awaitArrival(Posture posture) {
    SCOPED_TRACE(postureName(posture));
    const size_t before = bench_.ends().size();
    for (int i = 0; i < 20 * 125 && bench_.ends().size() == before; ++i) {
      passFrame();
    }
    ASSERT_GT(bench_.ends().size(), before)
        << "it does not arrive: " << (bench_.errors().empty() ? "no error" : bench_.errors().back());
    const physics::End& end = bench_.ends().back();
    EXPECT_EQ(end.what, version2::ENDED_POSTURE);
    EXPECT_EQ(end.how, version2::END_DONE) << end.reason;
    EXPECT_EQ(end.name, postureName(posture));
    for (int i = 0; i < 125; ++i) {
      passFrame();
    }
    EXPECT_LT(highest_tilt_, 50 * kDegree);
    highest_tilt_ = 0;
  }

  physics::Bench& bench() { return bench_; }

 private:
  void passFrame() {
    bench_.passFrame();
    highest_tilt_ = std::max(highest_tilt_, bench_.robot().tilt());
  }

  physics::Bench bench_;
  double highest_tilt_ = 0;
};

void expectStands(physics::PhysicalErs7& robot) {
  EXPECT_FALSE(robot.bodyTouchesFloor());
  EXPECT_LT(robot.tilt(), 5 * kDegree);
  for (int leg = 0; leg < robot_model::NUMBER_OF_LEGS; ++leg) {
    EXPECT_TRUE(robot.touchesFloor(static_cast<robot_model::Leg>(leg))) << leg;
  }
}

class Postures : public ::testing::TestWithParam<World> {};

TEST_P(Postures, CanBeTakenFromEachOther) {
  PostureTaker taker(GetParam());
  for (const Posture posture :
       {version2::POSTURE_STAND, version2::POSTURE_SIT, version2::POSTURE_STAND, version2::POSTURE_REST,
        version2::POSTURE_SIT, version2::POSTURE_REST, version2::POSTURE_STAND}) {
    if (!taker.bench().robot().motorsPull()) {
      taker.bench().switchMotors(true);
    }
    taker.take(posture);
    EXPECT_EQ(taker.bench().robot().motorsPull(), posture != version2::POSTURE_REST);
    if (posture == version2::POSTURE_STAND) {
      expectStands(taker.bench().robot());
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

}  // namespace
