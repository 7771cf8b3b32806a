/// @file stance.h
/// The stance of the simulated robot on its legs.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_BODY_STANCE_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_BODY_STANCE_H

#include <Eigen/Geometry>
#include <array>
#include <cstddef>

#include "robot_model/legs.h"

namespace simulated_ers7 {

using robot_model::Leg;
using robot_model::LegAngles;

constexpr std::size_t kLegs = robot_model::NUMBER_OF_LEGS;

/// Travel of a paw's switch in metres: a foot that is no higher over the floor presses it. Our choice, because joints
/// are a few hundredths of a degree off their commands, and a real floor is not flat either.
constexpr double kPawTravel = 0.003;

/// Centre of the foot's ball in the body, in metres.
Eigen::Vector3d footInBody(Leg leg, const LegAngles& angles);

struct Stance {
  Eigen::Isometry3d body;            ///< in the room (scene.h), over its origin, facing along x
  std::array<bool, kLegs> paw_down;  ///< the foot is not higher over the floor than kPawTravel
};

/// The stance in which the robot comes to rest on the floor, with its weight in the body's origin.
///
/// It stands on three supports out of its feet and the four corners of its belly. These surround its weight, at least
/// nearly, and no other support is below their plane. If there are several such planes, the most level one counts.
/// Nothing slides or falls over.
Stance standOn(const std::array<LegAngles, kLegs>& legs);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_STANCE_H
