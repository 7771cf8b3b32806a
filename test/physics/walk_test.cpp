#include <gmock/gmock.h>

#include <cmath>

#include "trial.h"

namespace {

using physics::Record;
using physics::World;

namespace version2 = protocol::version2;

constexpr int kWorlds = 8;
constexpr double kSecondsOfDirection = 5;

/// Of all worlds.
struct Spread {
  double middle;
  double highest;
};

Spread spreadOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values[values.size() / 2], values.back()};
}

/// What must hold on every robot and every floor.
void expectNoHarm(const Record& record) {
  EXPECT_FALSE(record.fell);
  EXPECT_LT(record.highest_tilt, 0.26);
  EXPECT_LT(record.highest_speed, 1.1);
  EXPECT_LT(record.at_full_duty, 0.03);
  EXPECT_LT(record.legs_touch, 0.1);
  EXPECT_GT(record.usual_lift, 0.002);
  EXPECT_EQ(record.beyond_limits, 0);
  EXPECT_THAT(record.errors, testing::IsEmpty());
  for (const physics::End& end : record.ends) {
    EXPECT_EQ(end.how, version2::END_DONE) << end.reason;  // it was steered to stand
  }
}

/// By how much the body's velocity along an axis is wrong, in parts of what is commanded, or in its unit if nothing is.
double errorOf(const Record& record, double commanded, std::size_t axis) {
  const double walked = record.walked[axis];
  return commanded == 0 ? std::abs(walked) : std::abs(walked / commanded - 1);
}

TEST(Walk, GoesInAllDirectionsOnManyRobotsAndFloors) {
  const std::vector<World> worlds = physics::sampleOfWorlds(kWorlds, 1);
  for (const physics::Direction& direction : physics::directionsWithin(physics::walkLimits())) {
    SCOPED_TRACE(direction.name);
    std::vector<double> lifts;
    std::array<std::vector<double>, Record::kAxes> errors;
    const Record::Axes commanded = {direction.velocity.forward, direction.velocity.left, direction.velocity.turn};
    for (const World& world : worlds) {
      SCOPED_TRACE(describe(world));
      const Record record = physics::walk(world, physics::always(direction.velocity), kSecondsOfDirection);
      expectNoHarm(record);
      lifts.push_back(-record.usual_lift);
      for (std::size_t axis = 0; axis < Record::kAxes; ++axis) {
        errors[axis].push_back(errorOf(record, commanded[axis], axis));
      }
    }
    EXPECT_LT(spreadOf(lifts).middle, -0.005) << "metres";
    for (std::size_t axis = 0; axis < Record::kAxes; ++axis) {
      SCOPED_TRACE(axis);
      const Spread error = spreadOf(errors[axis]);
      EXPECT_LT(error.middle, commanded[axis] != 0 ? 0.25 : 0.035);
      EXPECT_LT(error.highest, commanded[axis] != 0 ? 0.65 : 0.15);
    }
  }
}

TEST(Walk, KeepsItsBalanceOnSlopes) {
  for (const std::size_t floor : {4U, 5U}) {  // 6 degrees up and to the left
    std::vector<double> missing;
    std::vector<double> turns;
    for (const World& world : physics::sampleOfWorlds(kWorlds, 1)) {
      const World slope = onFloor(world, physics::unevenFloors()[floor]);
      const Record record = physics::walk(slope, physics::always({0.1, 0, 0}), kSecondsOfDirection);
      EXPECT_FALSE(record.fell) << describe(slope);
      missing.push_back(errorOf(record, 0.1, 0));
      turns.push_back(errorOf(record, 0, 2));
    }
    EXPECT_LT(spreadOf(missing).middle, 0.1);
    EXPECT_LT(spreadOf(turns).middle, 0.08);
  }
}

TEST(Walk, FollowsRandomCommands) {
  const Record record = physics::walk(World(), physics::randomly(physics::walkLimits(), 1), 120);
  expectNoHarm(record);
  EXPECT_GT(record.usual_lift, 0.005);
  EXPECT_LT(record.legs_touch, 0.005);
  for (const double gain : record.gain) {
    EXPECT_NEAR(gain, 1, 0.1);
  }
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
