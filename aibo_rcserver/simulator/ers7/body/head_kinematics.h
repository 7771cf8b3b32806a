/// @file head_kinematics.h
/// Where the ERS-7's camera is and where it looks.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_BODY_HEAD_KINEMATICS_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_BODY_HEAD_KINEMATICS_H

#include <Eigen/Geometry>

namespace simulated_ers7 {

/// Angles of the three joints between body and camera, in radian. All zero: the neck straight up, looking ahead.
/// Software limits as in Sony's Model Information ERS-7, section 2.1.1; nothing here enforces them.
struct HeadAngles {
  double neck_tilt = 0;  ///< -75..0 degrees, positive lifts the head
  double head_pan = 0;   ///< -88..88 degrees, positive to the left
  double head_tilt = 0;  ///< -15..45 degrees, positive looks up
};

/// How high the body's origin, the middle between the joints of its four legs, stands over the floor, in metres
/// (Webots' model of the ERS-7).
constexpr double kStandingHeight = 0.143;

/// Pose of the head in the body: origin where the axes of head_pan and head_tilt meet, x towards the nose, y left, z
/// up. Metres.
Eigen::Isometry3d headInBody(const HeadAngles& angles);

/// Pose of the camera in the body: origin in its pinhole, x along its axis of sight, y left, z up. Metres.
Eigen::Isometry3d cameraInBody(const HeadAngles& angles);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_HEAD_KINEMATICS_H
