/// @file odometry.h
#ifndef AIBO_DRIVER_WALK_ODOMETRY_H
#define AIBO_DRIVER_WALK_ODOMETRY_H

#include <Eigen/Core>

#include "aibo_client/walk.h"

namespace aibo_driver::walk {

/// Where a robot has walked to, and how uncertain that is. It begins at the origin, without any uncertainty.
///
/// Every step adds to the uncertainty. An uncertain direction also makes the robot's later positions uncertain. Nothing
/// ever reduces the uncertainty, because the robot does not see where it is.
class Odometry {
 public:
  /// Standard deviations. They are our choice: twice the errors of a trial of the gait in simulated physics, on floors
  /// of different friction. Errors of distance and turn are independent of each other and of earlier errors.
  /// @{
  static constexpr double kDistanceAfterMetre = 0.1;    ///< m, ahead and to the side, after 1 m
  static constexpr double kTurnAfterMetre = 0.15;       ///< rad, after 1 m
  static constexpr double kTurnAfterRadian = 0.1;       ///< rad, after a turn by 1 rad
  static constexpr double kDistanceAfterRadian = 0.01;  ///< m, after a turn by 1 rad
  /// @}

  /// Call this when the robot has walked on.
  /// @param velocity the average velocity
  /// @param time how long the robot walked, in s
  void walk(const aibo_client::WalkVelocity& velocity, double time);

  /// Call this when the robot may have been moved to an unknown place.
  /// @param distance, turn standard deviations that are added, in m and rad
  void lose(double distance, double turn);

  double x() const { return x_; }      ///< m, in the direction that the robot had at the beginning
  double y() const { return y_; }      ///< m, to the left of that direction
  double yaw() const { return yaw_; }  ///< rad, -pi..pi, counterclockwise

  /// The covariance of x, y and yaw.
  const Eigen::Matrix3d& covariance() const { return covariance_; }

 private:
  double x_ = 0;
  double y_ = 0;
  double yaw_ = 0;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
};

}  // namespace aibo_driver::walk

#endif  // AIBO_DRIVER_WALK_ODOMETRY_H
