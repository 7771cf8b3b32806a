/// @file stance.h
/// How an ERS-7 is on the floor, estimated from its legs and its accelerometer.
#ifndef AIBO_DRIVER_ROS_BODY_STANCE_H
#define AIBO_DRIVER_ROS_BODY_STANCE_H

#include <Eigen/Geometry>
#include <array>
#include <cstddef>

#include "robot_model/legs.h"

namespace aibo_driver::node {

using robot_model::Leg;
using robot_model::LegAngles;

constexpr std::size_t kLegs = robot_model::NUMBER_OF_LEGS;

/// Centre of the ball that is the foot, in metres, in base_link.
Eigen::Vector3d footOf(Leg leg, const LegAngles& angles);

/// The body over the floor.
struct Stance {
  Eigen::Isometry3d body;  ///< base_link in base_footprint: the floor below it, x forward, z up
  std::array<bool, kLegs> foot_on_floor;
};

/// The robot is taken to be on a flat floor, and to touch it with its feet or with the corners of its belly. The lowest
/// of these are those that bear it: each three of them that have no other below their plane might do so, and those
/// whose plane is closest to what the accelerometer calls level do. Their plane is more precise than the accelerometer
/// and has no noise. If none is within kTrust of it, as in somebody's hands, the accelerometer alone counts, and the
/// lowest support is put on the floor.
///
/// It is an estimate: the accelerometer also measures motion, the floor need not be flat, and a robot that lies on its
/// side or its back touches it with other parts.
/// @param acceleration measured in base_link, as in imu/data_raw: upwards at rest; only its direction counts
Stance estimateStance(const std::array<LegAngles, kLegs>& legs, const Eigen::Vector3d& acceleration);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_BODY_STANCE_H
