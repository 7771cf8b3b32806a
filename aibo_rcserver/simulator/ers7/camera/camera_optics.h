/// @file camera_optics.h
/// The ERS-7's camera as an ideal pinhole: the direction of each point in the picture.
///
/// Points in the picture are in pixels of the H layer: x to the right, y down, with (0, 0) in the upper left corner of
/// the upper left pixel, so the centre of pixel (0, 0) is at (0.5, 0.5).
/// Points in front of the camera are in its frame as in head_kinematics.h: x ahead, y left, z up.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_CAMERA_OPTICS_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_CAMERA_OPTICS_H

#include <Eigen/Core>

namespace simulated_ers7 {

/// Size of the H layer in pixels.
constexpr int kPictureWidth = 208;
constexpr int kPictureHeight = 160;

/// Field of view in degrees (Sony, Model Information ERS-7).
constexpr double kHorizontalFieldOfView = 56.9;
constexpr double kVerticalFieldOfView = 45.2;

/// Horizontal and vertical focal length in pixels, computed from the field of view: 191.9 and 192.2.
double focalLengthX();
double focalLengthY();

/// The direction, of length 1, of a point in the picture.
Eigen::Vector3d directionOf(const Eigen::Vector2d& place);

/// The point in the picture, or outside it, where a point in front of the camera (x > 0) appears.
Eigen::Vector2d placeOf(const Eigen::Vector3d& point);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_CAMERA_OPTICS_H
