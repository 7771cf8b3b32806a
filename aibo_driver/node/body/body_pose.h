/// @file body_pose.h
#ifndef AIBO_DRIVER_NODE_BODY_BODY_POSE_H
#define AIBO_DRIVER_NODE_BODY_BODY_POSE_H

#include <geometry_msgs/Transform.h>
#include <geometry_msgs/Vector3.h>
#include <ros/time.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "walk/stance.h"

namespace aibo_driver::node {

/// The name of a leg's joint, such as "left_front_rotator".
/// @param leg 0..3: robot_model::Leg
/// @param joint 0 for the rotator, 1 for the elevator, 2 for the knee
std::string legJointName(std::size_t leg, std::size_t joint);

/// The pose of an ERS-7's body above the floor: base_link in base_footprint. stance.h says how this is estimated. The
/// acceleration is smoothed, because the accelerometer also measures every step of the robot.
///
/// Only one thread at a time may use an object of this class.
class BodyPose {
 public:
  /// Call this with each measurement of the accelerometer.
  /// @param acceleration the value in imu/data_raw
  void accelerate(const geometry_msgs::Vector3& acceleration, const ros::Time& stamp);

  /// Whether an acceleration has been measured. Without one, the body is taken to be level.
  bool isKnown() const { return acceleration_.has_value(); }

  geometry_msgs::Transform above(const std::array<walk::LegAngles, walk::kLegs>& legs) const;

 private:
  std::optional<Eigen::Vector3d> acceleration_;  ///< smoothed
  ros::Time last_acceleration_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_BODY_BODY_POSE_H
