/// @file odometry.h
#ifndef AIBO_DRIVER_ROS_WALK_ODOMETRY_H
#define AIBO_DRIVER_ROS_WALK_ODOMETRY_H

#include <Eigen/Core>

#include "aibo_driver/walk.h"

namespace aibo_driver::node {

/// Where a robot has walked to, and how uncertain that is. It begins at the origin, and without any uncertainty.
///
/// Every step adds to the uncertainty, and an uncertain direction makes the place uncertain that lies ahead. Nothing
/// ever reduces it: the robot does not see where it is.
class Odometry {
 public:
  /// Standard deviations, our choice: twice what a trial of the gait in simulated physics, on floors of different
  /// friction, was off. Way and turns are independent of each other, and of those before.
  /// @{
  static constexpr double kWayAfterMetre = 0.1;    ///< m, along and across, after 1 m
  static constexpr double kTurnAfterMetre = 0.15;  ///< rad, after 1 m
  static constexpr double kTurnAfterRadian = 0.1;  ///< rad, after a turn by 1 rad
  static constexpr double kWayAfterRadian = 0.01;  ///< m, after a turn by 1 rad
  /// @}

  /// The robot has walked on.
  /// @param velocity on average
  /// @param time s
  void walk(const WalkVelocity& velocity, double time);

  /// The robot may have gone somewhere else, and it is not known where.
  /// @param way, turn standard deviations that are added, in m and rad
  void lose(double way, double turn);

  double x() const { return x_; }      ///< m, in the direction in which it stood at the beginning
  double y() const { return y_; }      ///< m, to the left of it
  double yaw() const { return yaw_; }  ///< rad, -pi..pi, counterclockwise

  /// Of x, y and yaw.
  const Eigen::Matrix3d& covariance() const { return covariance_; }

 private:
  double x_ = 0;
  double y_ = 0;
  double yaw_ = 0;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_WALK_ODOMETRY_H
