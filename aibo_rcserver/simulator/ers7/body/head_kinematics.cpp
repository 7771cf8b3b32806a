#include "simulator/ers7/body/head_kinematics.h"

namespace simulated_ers7 {
namespace {

const Eigen::Translation3d kNeckInBody(robot_model::NECK_FORWARD, 0, robot_model::NECK_UP);
const Eigen::Translation3d kHeadOnNeck(0, 0, robot_model::NECK_LENGTH);
const Eigen::Translation3d kCameraInHead(robot_model::CAMERA_FORWARD, 0, robot_model::CAMERA_UP);

/// A positive angle tilts up. This is a negative rotation about y, which points left.
Eigen::AngleAxisd tilt(double angle) {
  return Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitY());
}

Eigen::AngleAxisd pan(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ());
}

}  // namespace

Eigen::Isometry3d headInBody(const HeadAngles& angles) {
  return kNeckInBody * tilt(angles.neck_tilt) * kHeadOnNeck * pan(angles.head_pan) * tilt(angles.head_tilt);
}

Eigen::Isometry3d cameraInBody(const HeadAngles& angles) {
  return headInBody(angles) * kCameraInHead;
}

}  // namespace simulated_ers7
