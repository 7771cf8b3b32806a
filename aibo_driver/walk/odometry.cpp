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
  const double step_x = forward * std::cos(direction) - left * std::sin(direction);
  const double step_y = forward * std::sin(direction) + left * std::cos(direction);
  x_ += step_x;
  y_ += step_y;
  yaw_ = std::remainder(yaw_ + turn, 2 * M_PI);

  Eigen::Matrix3d change = Eigen::Matrix3d::Identity();
  change(0, 2) = -step_y;
  change(1, 2) = step_x;
  covariance_ = change * covariance_ * change.transpose();
  const double distance = std::hypot(velocity.forward, velocity.left) * time;
  const double distance_variance =
      square(kDistanceAfterMetre) * distance + square(kDistanceAfterRadian) * std::abs(turn);
  const double turn_variance = square(kTurnAfterMetre) * distance + square(kTurnAfterRadian) * std::abs(turn);
  lose(std::sqrt(distance_variance), std::sqrt(turn_variance));
}

void Odometry::lose(double distance, double turn) {
  covariance_(0, 0) += square(distance);
  covariance_(1, 1) += square(distance);
  covariance_(2, 2) += square(turn);
  if (covariance_(2, 2) > kLargestTurnVariance) {
    const double factor = std::sqrt(kLargestTurnVariance / covariance_(2, 2));
    covariance_.row(2) *= factor;
    covariance_.col(2) *= factor;
  }
}

}  // namespace aibo_driver::walk
