/// @file tipping.h
/// How the simulated robot's body tips from one stance to the next.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_BODY_TIPPING_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_BODY_TIPPING_H

#include "simulator/ers7/body/stance.h"

namespace simulated_ers7 {

/// Speed at which the body tips, in rad/s for each metre between its weight and its supports. It replaces dynamics, and
/// is slower than a real fall (our choice). On two diagonal feet, with its weight 2 cm beside them, the body tips by
/// one degree within half a step of a trot (0.2 s), so the robot does not rock from stance to stance in a trot. Without
/// its front feet, the body still drops by 20 degrees in a second.
constexpr double kTippingSpeed = 5;

/// The floor under the body one frame later. The body tips towards its weight until it rests. It tips in the direction
/// that lowers the weight most.
/// @param supports the current supports
/// @param rest restOn(supports)
/// @param slope the floor's slope before
Floor tip(const Supports& supports, const Rest& rest, const Eigen::Vector2d& slope, double seconds);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_TIPPING_H
