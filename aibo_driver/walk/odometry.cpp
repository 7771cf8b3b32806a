#include "walk/odometry.h"

#include <cmath>

namespace aibo_driver::walk {
namespace {

// With a standard deviation of half a turn, the direction is unknown.
constexpr double kLargestTurnVariance = M_PI * M_PI;

double square(double value) {
  return value * value;
}

}  // namespace

// With a steady velocity, the robot walks along an arc. The chord of the arc has the direction that the robot has in
// the middle of the turn.
void Odometry::walk(const aibo_client::WalkVelocity& velocity, double time) {
  const double turn = velocity.turn * time;
  const double chord = std::abs(turn) < 1e-6 ? 1.0 : std::sin(turn / 2) / (turn / 2);
  const double direction = yaw_ + turn / 2;
  const double forward = velocity.forward * time * chord;
  const double left = velocity.left * time * chord;
  const double way_x = forward * std::cos(direction) - left * std::sin(direction);
  const double way_y = forward * std::sin(direction) + left * std::cos(direction);
  x_ += way_x;
  y_ += way_y;
  yaw_ = std::remainder(yaw_ + turn, 2 * M_PI);

  Eigen::Matrix3d change = Eigen::Matrix3d::Identity();
  change(0, 2) = -way_y;
  change(1, 2) = way_x;
  covariance_ = change * covariance_ * change.transpose();
  const double way = std::hypot(velocity.forward, velocity.left) * time;
  const double way_variance = square(kWayAfterMetre) * way + square(kWayAfterRadian) * std::abs(turn);
  const double turn_variance = square(kTurnAfterMetre) * way + square(kTurnAfterRadian) * std::abs(turn);
  lose(std::sqrt(way_variance), std::sqrt(turn_variance));
}

void Odometry::lose(double way, double turn) {
  covariance_(0, 0) += square(way);
  covariance_(1, 1) += square(way);
  covariance_(2, 2) += square(turn);
  if (covariance_(2, 2) > kLargestTurnVariance) {
    const double factor = std::sqrt(kLargestTurnVariance / covariance_(2, 2));
    covariance_.row(2) *= factor;
    covariance_.col(2) *= factor;
  }
}

}  // namespace aibo_driver::walk
