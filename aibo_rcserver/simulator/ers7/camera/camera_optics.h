/// @file camera_optics.h
/// The ERS-7's camera as an ideal pinhole: the direction of each point in the picture.
///
/// Points in the picture are in pixels of layer H: x to the right, y down, from the upper left corner of the picture.
/// So the centre of the first pixel is at (0.5, 0.5). Points in front of the camera are in its frame
/// (head_kinematics.h): x ahead, y left, z up.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_CAMERA_OPTICS_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_CAMERA_OPTICS_H

#include <Eigen/Core>

namespace simulated_ers7 {

/// Layer H, in pixels.
constexpr int kPictureWidth = 208;
constexpr int kPictureHeight = 160;

/// In degrees (Sony, Model Information ERS-7).
constexpr double kHorizontalFieldOfView = 56.9;
constexpr double kVerticalFieldOfView = 45.2;

/// In pixels, from the field of view: 191.9 and 192.2.
double focalLengthX();
double focalLengthY();

/// The direction of a point in the picture, of length 1.
Eigen::Vector3d directionOf(const Eigen::Vector2d& place);

/// The point in the picture's plane for a point in front of the camera (x > 0); it may be outside the picture.
Eigen::Vector2d placeOf(const Eigen::Vector3d& point);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_CAMERA_OPTICS_H
