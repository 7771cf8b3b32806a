/// @file stance.h
/// How the simulated robot stands on its legs.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_BODY_STANCE_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_BODY_STANCE_H

#include <Eigen/Geometry>
#include <array>
#include <cstddef>

namespace simulated_ers7 {

/// Angles of the three joints of one leg, in radian. All zero: straight down.
struct LegAngles {
  double rotator = 0;   ///< positive swings the leg forward
  double elevator = 0;  ///< positive lifts it away from the body
  double knee = 0;      ///< positive bends: front legs forward, hind legs backward
};

enum Leg : std::size_t { kLeftFrontLeg, kLeftHindLeg, kRightFrontLeg, kRightHindLeg };

constexpr std::size_t kLegs = 4;

/// Radius of the ball that a foot is, in metres.
constexpr double kFootRadius = 0.013;

/// A paw's switch gives way by this much, in metres: a foot that is not higher over the floor presses it. Our choice:
/// joints stand to a few hundredths of a degree where they were commanded, and a real floor is no plane either.
constexpr double kPawTravel = 0.003;

/// Middle of the foot's ball in the body, in metres.
Eigen::Vector3d footInBody(Leg leg, const LegAngles& angles);

struct Stance {
  Eigen::Isometry3d body;            ///< in the room (scene.h), over its origin, turned to where x points
  std::array<bool, kLegs> paw_down;  ///< the foot is on the floor, or not higher than kPawTravel
};

/// How a robot comes to rest on these legs on the floor, with its weight in the body's origin.
///
/// It stands on three of its feet and of the four corners of its belly: those that are around its weight, or nearly so,
/// and have no other under their plane; if there are several such, those of the most level plane. Nothing slides or
/// falls over.
Stance standOn(const std::array<LegAngles, kLegs>& legs);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_STANCE_H
