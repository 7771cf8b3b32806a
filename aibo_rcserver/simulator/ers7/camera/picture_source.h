/// @file picture_source.h
/// Where the camera gets its pictures from.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_PICTURE_SOURCE_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_PICTURE_SOURCE_H

#include <OPENR/OPENR.h>

#include <Eigen/Geometry>

#include "simulator/ers7/body/head_kinematics.h"
#include "simulator/ers7/camera/camera_settings.h"
#include "simulator/ers7/camera/ycrcb_image.h"

namespace simulated_ers7 {

class PictureSource {
 public:
  virtual ~PictureSource() = default;

  /// Turns the head with the camera in it. Counts from the next picture.
  virtual void setHead(const HeadAngles& angles) = 0;

  /// Moves the body that carries the head. Counts from the next picture.
  /// @param in_room its pose in the scene (scene.h)
  virtual void setBody(const Eigen::Isometry3d& in_room) = 0;

  /// What the camera sees.
  /// @param seconds since the robot was switched on
  /// @param image_number of the camera's image, in which its noise differs from the others'
  /// @return valid until the next call
  virtual const YCrCbImage& picture(double seconds, longword image_number, const CameraSettings& settings) = 0;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_PICTURE_SOURCE_H
