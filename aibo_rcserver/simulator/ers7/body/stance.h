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

/// What the robot can rest on: the centres of its feet, then the corners of its belly, in the body, in metres. All are
/// balls with the radius of a foot.
using Supports = std::array<Eigen::Vector3d, 2 * kLegs>;

Supports supportsOf(const std::array<LegAngles, kLegs>& legs);

/// The floor as the body sees it, through the centres of the balls that touch it: z = slope.x * x + slope.y * y +
/// height.
struct Floor {
  Eigen::Vector2d slope;
  double height;
};

/// The floor with this slope under the lowest of the supports.
Floor floorUnder(const Supports& supports, const Eigen::Vector2d& slope);

/// How the robot comes to rest.
struct Rest {
  Floor floor;
  Eigen::Vector2d weight;  ///< from the body's origin, seen from above. The robot leans to have it over its supports
};

/// It rests on three supports that surround its weight, which is in the body's origin, at least nearly; no other
/// support is below their plane. If there are several such planes, the most level one counts. Nothing slides.
Rest restOn(const Supports& supports);

struct Stance {
  Eigen::Isometry3d body;            ///< in the room (scene.h)
  std::array<bool, kLegs> paw_down;  ///< the foot is not higher over the floor than kPawTravel
};

/// The stance of a body with this floor, over the room's origin and facing along x.
Stance stanceOver(const Floor& floor, const Supports& supports);

/// The stance in which the robot comes to rest on the floor.
Stance standOn(const std::array<LegAngles, kLegs>& legs);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_STANCE_H
