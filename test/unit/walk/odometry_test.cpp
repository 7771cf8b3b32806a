#include "walk/odometry.h"

#include <gmock/gmock.h>

#include <Eigen/LU>

#include <cmath>

namespace aibo_driver::walk {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Walks for a time in so many steps.
void walk(Odometry* odometry, const aibo_client::WalkVelocity& velocity, double time, int steps) {
  for (int i = 0; i < steps; ++i) {
    odometry->walk(velocity, time / steps);
  }
}

TEST(Odometry, TurnsCounterclockwiseAndThenGoesThatWay) {
  Odometry odometry;
  odometry.walk({0, 0, kPi / 2}, 1);
  odometry.walk({0.1, 0, 0}, 1);
  odometry.walk({0, 0.1, 0}, 2);
  EXPECT_NEAR(odometry.x(), -0.2, 1e-12);
  EXPECT_NEAR(odometry.y(), 0.1, 1e-12);
  EXPECT_NEAR(odometry.yaw(), kPi / 2, 1e-12);
}

TEST(Odometry, GoesAlongTheSameArcInOneStepAndInMany) {
  for (const int steps : {1, 7, 1000}) {
    Odometry odometry;
    walk(&odometry, {0.1, 0, 0.5}, kPi, steps);  // a quarter of a circle with a radius of 0.2 m
    EXPECT_NEAR(odometry.x(), 0.2, 1e-9) << steps;
    EXPECT_NEAR(odometry.y(), 0.2, 1e-9) << steps;
    EXPECT_NEAR(odometry.yaw(), kPi / 2, 1e-9) << steps;
  }
}

TEST(Odometry, KeepsTheDirectionBetweenMinusPiAndPi) {
  Odometry odometry;
  walk(&odometry, {0, 0, 1}, 4, 125);
  EXPECT_NEAR(odometry.yaw(), 4 - 2 * kPi, 1e-9);
  walk(&odometry, {0, 0, -1}, 8, 250);
  EXPECT_NEAR(odometry.yaw(), 2 * kPi - 4, 1e-9);
}

TEST(Odometry, IsAsUncertainAsItSaysAfterAMetreAndAfterARadian) {
  Odometry straight;
  straight.walk({0.1, 0, 0}, 10);
  EXPECT_NEAR(std::sqrt(straight.covariance()(0, 0)), Odometry::kDistanceAfterMetre, 1e-9);
  EXPECT_NEAR(std::sqrt(straight.covariance()(2, 2)), Odometry::kTurnAfterMetre, 1e-9);
  Odometry sideways;
  sideways.walk({0, -0.1, 0}, 10);
  EXPECT_NEAR(std::sqrt(sideways.covariance()(0, 0)), Odometry::kDistanceAfterMetre, 1e-9);
  Odometry turning;
  turning.walk({0, 0, -0.5}, 2);
  EXPECT_NEAR(std::sqrt(turning.covariance()(0, 0)), Odometry::kDistanceAfterRadian, 1e-9);
  EXPECT_NEAR(std::sqrt(turning.covariance()(2, 2)), Odometry::kTurnAfterRadian, 1e-9);
}

TEST(Odometry, ThatHasLostItsWayKeepsItsPlace) {
  Odometry odometry;
  odometry.walk({0.1, 0, 0}, 10);
  for (int i = 0; i < 10; ++i) {
    odometry.lose(1, 3.2);
  }
  EXPECT_NEAR(odometry.x(), 1, 1e-9);
  EXPECT_GT(odometry.covariance()(0, 0), 10);
  EXPECT_NEAR(odometry.covariance()(2, 2), kPi * kPi, 1e-9) << "more than any direction is not possible";
}

}  // namespace
}  // namespace aibo_driver::walk
