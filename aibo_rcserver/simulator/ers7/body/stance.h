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

/// In metres. A foot this high above the floor still presses its switch (our choice): joints are a few hundredths of a
/// degree off their commands, and real floors are not flat.
constexpr double kPawTravel = 0.003;

/// In metres.
Eigen::Vector3d footInBody(Leg leg, const LegAngles& angles);

/// What the robot can rest on: the centres of its feet, then the corners of its belly, in the body, in metres. All are
/// balls with the radius of a foot.
using Supports = std::array<Eigen::Vector3d, 2 * kLegs>;

Supports supportsOf(const std::array<LegAngles, kLegs>& legs);

/// The floor in the body's frame, through the centres of the balls that touch it: z = slope.x * x + slope.y * y +
/// height.
struct Floor {
  Eigen::Vector2d slope;
  double height;
};

/// The floor with this slope that touches the lowest support.
Floor floorUnder(const Supports& supports, const Eigen::Vector2d& slope);

struct Rest {
  Floor floor;
  /// Seen from above, from the body's origin. The robot leans to have its weight over its supports.
  Eigen::Vector2d weight;
};

/// Finds three supports that surround the weight, which is in the body's origin, at least nearly. No other support may
/// be below their plane. Of several such planes, the most level one counts. Nothing slides.
Rest restOn(const Supports& supports);

struct Stance {
  Eigen::Isometry3d body;            ///< in the room (scene.h)
  std::array<bool, kLegs> paw_down;  ///< the foot is at most kPawTravel above the floor
};

/// The body is over the room's origin and faces along x.
Stance stanceOver(const Floor& floor, const Supports& supports);

/// The stance at rest on the floor.
Stance standOn(const std::array<LegAngles, kLegs>& legs);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_STANCE_H
