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

constexpr double kGravity = 9.80665;  // m/s^2

/// The height above the floor, in metres, up to which a foot presses its switch (our choice). It is not 0, because
/// joints are a few hundredths of a degree off their commands and real floors are not flat.
constexpr double kPawTravel = 0.003;

/// The centre of a foot in the body's frame, in metres.
Eigen::Vector3d footInBody(Leg leg, const LegAngles& angles);

/// The supports that the robot can rest on: the centres of its feet, then the corners of its belly, in the body's
/// frame, in metres. Each is a ball with the radius of a foot.
using Supports = std::array<Eigen::Vector3d, 2 * kLegs>;

Supports supportsOf(const std::array<LegAngles, kLegs>& legs);

/// How far each support has rolled while the legs have moved, in the body's frame, in metres. The belly does not roll.
Supports rolledBetween(const std::array<LegAngles, kLegs>& before, const std::array<LegAngles, kLegs>& now);

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
  /// The weight seen from above, relative to the body's origin. The robot leans to keep its weight over its supports.
  Eigen::Vector2d weight;
};

/// Finds three supports that surround the weight, or nearly surround it. The weight is in the body's origin. No other
/// support is below their plane. Of several such planes, the most level one is chosen. The supports do not slide.
Rest restOn(const Supports& supports);

/// Speed at which the body tips, in rad/s for each metre between its weight and its supports. It replaces dynamics, and
/// is slower than a real fall (our choice). On two diagonal feet, with its weight 2 cm beside them, the body tips by
/// one degree within half a step of a trot (0.2 s), so the robot does not rock from stance to stance in a trot. Without
/// its front feet, the body still drops by 20 degrees in a second.
constexpr double kTippingSpeed = 5;

/// The floor under the body one frame later. The body tips towards its weight until it rests. It tips in the direction
/// that lowers the weight most.
/// @param supports the current supports
/// @param rest restOn(supports)
/// @param slope the floor's slope one frame earlier
Floor tip(const Supports& supports, const Rest& rest, const Eigen::Vector2d& slope, double seconds);

struct Stance {
  Eigen::Isometry3d body;            ///< in the room (scene.h)
  std::array<bool, kLegs> paw_down;  ///< the foot is at most kPawTravel above the floor
};

/// The stance of a body that is over the room's origin and faces along x.
Stance stanceOver(const Floor& floor, const Supports& supports);

/// The stance of a robot that rests on the floor.
Stance standOn(const std::array<LegAngles, kLegs>& legs);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_STANCE_H
