/// @file head_kinematics.h
/// Position and direction of the ERS-7's camera.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_BODY_HEAD_KINEMATICS_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_BODY_HEAD_KINEMATICS_H

#include <Eigen/Geometry>

#include "robot_model/head.h"

namespace simulated_ers7 {

using robot_model::HeadAngles;

/// Height of the body's origin, the centre of the joints of its four legs, over the floor, in metres (Webots' model of
/// the ERS-7).
constexpr double kStandingHeight = 0.143;

/// Pose of the head in the body: origin where the axes of head_pan and head_tilt meet, x towards the nose, y left, z
/// up. Metres.
Eigen::Isometry3d headInBody(const HeadAngles& angles);

/// Pose of the camera in the body: origin in its pinhole, x along its optical axis, y left, z up. Metres.
Eigen::Isometry3d cameraInBody(const HeadAngles& angles);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_HEAD_KINEMATICS_H
