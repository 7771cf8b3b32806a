#include "simulator/ers7/body/head_kinematics.h"

namespace simulated_ers7 {
namespace {

// Lengths of the head's links, in metres (Tekkotsu's kinematic table of the ERS-7).
const Eigen::Translation3d kNeckInBody(0.0675, 0, 0.0195);
const Eigen::Translation3d kHeadOnNeck(0, 0, 0.080);
const Eigen::Translation3d kCameraInHead(0.08106, 0, -0.0146);

/// Positive looks up, which is a negative rotation about y, because y points left.
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
