#include "walk/goal_controller.h"

#include <algorithm>
#include <cmath>

namespace aibo_driver::walk {

using aibo_client::WalkVelocity;

namespace {

// How close to the place the robot stops, and how far away it has to be to go there again.
constexpr double kStopAt = 0.02;         // m
constexpr double kGoAgainAt = 0.04;      // m
constexpr double kStopTurningAt = 0.03;  // rad

// This near, the robot does not turn towards the place any more. A guarded robot walks this far over ground that no
// sensor looks at.
constexpr double kAnyDirection = 0.04;  // m
constexpr double kSlowly = 0.03;        // m/s

// How far the robot's direction may be from that of the place when it walks ahead.
constexpr double kAhead = 0.5;  // rad

constexpr double kFastest = 0.2;       // m/s; the limits of the robot and of the driver are lower
constexpr double kFastestTurn = 0.8;   // rad/s
constexpr double kSlowDown = 0.8;      // m/s for each metre that is left
constexpr double kSlowDownTurn = 1.5;  // rad/s for each radian that is left

double turnFor(double angle) {
  return std::clamp(kSlowDownTurn * angle, -kFastestTurn, kFastestTurn);
}

}  // namespace

PlanePose inFrameOf(const PlanePose& origin, const PlanePose& pose) {
  return {origin.x + pose.x * std::cos(origin.yaw) - pose.y * std::sin(origin.yaw),
          origin.y + pose.x * std::sin(origin.yaw) + pose.y * std::cos(origin.yaw),
          std::remainder(origin.yaw + pose.yaw, 2 * M_PI)};
}

WalkVelocity GoalController::velocityAt(const PlanePose& here) {
  const double distance = distanceFrom(here);
  is_there_ = distance <= (is_there_ ? kGoAgainAt : kStopAt);
  if (is_there_) {
    const double turn = turnFrom(here);
    return {0, 0, std::abs(turn) <= kStopTurningAt ? 0 : turnFor(turn)};
  }
  const double bearing = std::remainder(std::atan2(goal_.y - here.y, goal_.x - here.x) - here.yaw, 2 * M_PI);
  if (distance <= kAnyDirection) {
    return {kSlowly * std::cos(bearing), kSlowly * std::sin(bearing), 0};
  }
  const double speed = std::abs(bearing) < kAhead ? std::min(kFastest, kSlowDown * distance) : 0;
  return {speed * std::cos(bearing), 0, turnFor(bearing)};
}

double GoalController::distanceFrom(const PlanePose& here) const {
  return std::hypot(goal_.x - here.x, goal_.y - here.y);
}

double GoalController::turnFrom(const PlanePose& here) const {
  return std::remainder(goal_.yaw - here.yaw, 2 * M_PI);
}

}  // namespace aibo_driver::walk
