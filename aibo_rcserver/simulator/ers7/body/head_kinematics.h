/// @file head_kinematics.h
/// Position and direction of the ERS-7's camera.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_BODY_HEAD_KINEMATICS_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_BODY_HEAD_KINEMATICS_H

#include <Eigen/Geometry>

#include "robot_model/head.h"

namespace simulated_ers7 {

using robot_model::HeadAngles;

/// The height of the body's origin, in metres. The origin is the centre of the legs' four shoulder and hip joints
/// (Webots' model of the ERS-7).
constexpr double kStandingHeight = 0.143;

/// The head's pose in metres. The origin is the intersection of the axes of head_pan and head_tilt. The axis x points
/// to the nose, y to the left, and z up.
Eigen::Isometry3d headInBody(const HeadAngles& angles);

/// The camera's pose in metres. The origin is the pinhole. x points along the optical axis, y left, z up.
Eigen::Isometry3d cameraInBody(const HeadAngles& angles);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_HEAD_KINEMATICS_H
