/// @file stance.h
/// How an ERS-7 stands or lies on the floor, estimated from its legs and its accelerometer.
#ifndef AIBO_DRIVER_WALK_STANCE_H
#define AIBO_DRIVER_WALK_STANCE_H

#include <Eigen/Geometry>
#include <array>
#include <cstddef>

#include "robot_model/legs.h"

namespace aibo_driver::walk {

using robot_model::Leg;
using robot_model::LegAngles;

constexpr std::size_t kLegs = robot_model::NUMBER_OF_LEGS;

/// The centre of the ball that is the foot, in metres, in base_link.
Eigen::Vector3d footOf(Leg leg, const LegAngles& angles);

/// The pose of the body above the floor.
struct Stance {
  Eigen::Isometry3d body;  ///< base_link in base_footprint: the floor below it, x forward, z up
  std::array<bool, kLegs> foot_on_floor;
};

/// We assume that the robot is on a flat floor, and that it touches the floor with its feet or with the corners of its
/// belly. Three of these supports bear it. Any three that have no other support below their plane are possible; we take
/// those whose plane is closest to what the accelerometer calls level. Their plane is more precise than the
/// accelerometer and has no noise. If no plane is within kTrust of the accelerometer, for example because somebody
/// holds the robot, the accelerometer alone counts, and the lowest support is put on the floor.
///
/// The result is an estimate. The accelerometer also measures motion, the floor need not be flat, and a robot that lies
/// on its side or its back touches the floor with other parts.
/// @param acceleration measured in base_link, as in imu/data_raw: it points up at rest; only its direction counts
Stance estimateStance(const std::array<LegAngles, kLegs>& legs, const Eigen::Vector3d& acceleration);

}  // namespace aibo_driver::walk

#endif  // AIBO_DRIVER_WALK_STANCE_H
