/// @file tipping.h
/// How the simulated robot's body tips from one stance to the next.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_BODY_TIPPING_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_BODY_TIPPING_H

#include "simulator/ers7/body/stance.h"

namespace simulated_ers7 {

/// Speed at which the body tips, in rad/s for each metre between its weight and what it stands on. Our choice instead
/// of dynamics, slower than a real fall: on two diagonal feet, with its weight 2 cm beside them, the body tips by one
/// degree within half a step of a trot (0.2 s), so that a trot does not fall from one stance into the next; and without
/// its front feet it still drops by 20 degrees in a second.
constexpr double kTippingSpeed = 5;

/// The floor under the body a little later. It tips towards its weight until it is at rest: the slope after this time
/// is the one that lowers the weight most for the way that it tips.
/// @param supports as they are now
/// @param rest restOn(supports)
/// @param slope of the floor before
Floor tip(const Supports& supports, const Rest& rest, const Eigen::Vector2d& slope, double seconds);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_TIPPING_H
