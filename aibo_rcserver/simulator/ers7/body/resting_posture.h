/// @file resting_posture.h
/// How the simulated robot stands when it is switched on.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_BODY_RESTING_POSTURE_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_BODY_RESTING_POSTURE_H

#include <string>

#include "simulator/ers7/body/head_kinematics.h"

namespace simulated_ers7 {

/// Where a joint is, in microradian. A posture of our own: it stands on bent legs, the feet under shoulders and hips
/// and kStandingHeight below them, and looks at the ball.
/// @param joint a name of robot_model.h
/// @throw std::out_of_range if the ERS-7 has no such joint
int restingPosition(const std::string& joint);

/// The same of the head: it looks at the ball, and past it at the station.
HeadAngles restingHead();

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_RESTING_POSTURE_H
