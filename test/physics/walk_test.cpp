#include <gmock/gmock.h>

#include <iostream>
#include <string>

#include "trial.h"

namespace {

using physics::Record;
using physics::Velocity;
using physics::World;
using ::testing::IsEmpty;

namespace version2 = protocol::version2;

const World kUsual;
const World kWeakOnSmoothFloor = {0.7, 0.4};
const World kStrongOnRoughFloor = {3, 1};

void expectGoodWalk(const std::string& name, const World& world, const physics::Commands& commands, double seconds) {
  const Record record = physics::walk(world, commands, seconds);
  physics::print(name, record, std::cout);
  EXPECT_THAT(problemsOf(record), IsEmpty()) << name;
  for (const physics::End& end : record.ends) {
    EXPECT_EQ(end.how, version2::END_DONE) << name << ": " << end.reason;  // it was steered to stand
  }
}

TEST(Walk, GoesInAllDirections) {
  physics::printHeader(std::cout);
  for (const physics::Direction& direction : physics::directionsWithin(physics::walkLimits())) {
    expectGoodWalk(direction.name, kUsual, physics::always(direction.velocity), 45);
  }
}

TEST(Walk, GoesWithWeakAndStrongMotorsOnSmoothAndRoughFloors) {
  for (const World& world : {kWeakOnSmoothFloor, kStrongOnRoughFloor}) {
    for (const physics::Direction& direction : physics::directionsWithin(physics::walkLimits())) {
      const std::string name =
          direction.name + (world.friction < 0.5 ? std::string(", weak") : std::string(", strong"));
      expectGoodWalk(name, world, physics::always(direction.velocity), 10);
    }
  }
}

TEST(Walk, FollowsRandomCommands) {
  expectGoodWalk("random", kUsual, physics::randomly(physics::walkLimits(), 1), 120);
}

TEST(Walk, StopsWhereItStandsWithoutSteering) {
  physics::Bench bench;
  bench.steer({physics::walkLimits().forward, 0, 0});
  for (int i = 0; i < 500; ++i) {
    bench.passFrame();
  }
  EXPECT_EQ(bench.step().state, version2::WALK_STATE_WALKS);
  bench.letGo();
  const physics::End end = bench.awaitEnd(version2::ENDED_WALK, 3);
  EXPECT_EQ(end.how, version2::END_STOPPED) << end.reason;
  const Eigen::Vector3d place = bench.robot().body().translation();
  for (int i = 0; i < 250; ++i) {
    bench.passFrame();
  }
  EXPECT_LT((bench.robot().body().translation() - place).norm(), 0.01);
  EXPECT_LT(bench.robot().tilt(), 0.05);
}

TEST(Walk, IsTheSameInEveryRun) {
  Eigen::Vector3d places[2];
  for (Eigen::Vector3d& place : places) {
    physics::Bench bench;
    bench.steer({0.1, 0, 0.3});
    for (int i = 0; i < 500; ++i) {
      bench.passFrame();
    }
    place = bench.robot().body().translation();
  }
  EXPECT_EQ(places[0], places[1]);
  EXPECT_GT(places[0].norm(), 0.05);
}

}  // namespace
