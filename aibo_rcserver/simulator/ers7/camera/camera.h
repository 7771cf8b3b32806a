/// @file camera.h
/// The ERS-7's camera: settings, timing, and images in OPEN-R's layout.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_CAMERA_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_CAMERA_H

#include <OPENR/OPENR.h>
#include <OPENR/OPrimitiveControl.h>
#include <OPENR/RCRegion.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <map>

#include "simulator/ers7/body/head_kinematics.h"
#include "simulator/ers7/body/joints.h"
#include "simulator/ers7/camera/color_detection.h"
#include "simulator/ers7/camera/ycrcb_image.h"
#include "simulator/ers7/region_pool.h"
#include "simulator/openr_host/objects/filled_on_read.h"

namespace simulated_ers7 {

/// White balance and shutter begin as in Sony's Model Information ERS-7. Gain begins in the middle, and both automatic
/// modes begin off, so that all settings have an effect (our choice).
struct CameraSettings {
  longword white_balance = ocamparamWB_FL_MODE;
  longword gain = ocamparamGAIN_MID;
  longword shutter = ocamparamSHUTTER_MID;
  bool auto_exposure = false;       ///< while on, gain and shutter have no effect
  bool auto_white_balance = false;  ///< while on, white_balance has no effect
};

/// The number of images finished up to and including this OPEN-R frame. The first image is finished in frame 0.
///
/// The camera's own clock gives 29.88 images per second, but it is read every 8 ms. So most images come 32 ms after the
/// previous one, and some 40 ms. 60 images in 251 frames make 33.47 ms on average, as measured on an ERS-7 (Tekkotsu,
/// profilerun_ERS7_2.0).
constexpr longword imagesUpTo(longword frame) {
  constexpr std::uint64_t kImages = 60;
  constexpr std::uint64_t kFrames = 251;
  return static_cast<longword>(frame * kImages / kFrames + 1);
}

/// The next frame in which the camera finishes an image.
constexpr longword imageAfter(longword frame) {
  longword next = frame + 1;
  while (imagesUpTo(next) == imagesUpTo(frame)) {
    ++next;
  }
  return next;
}

/// The pose of the robot's camera.
struct CameraPose {
  HeadAngles head = restingHead();
  Eigen::Isometry3d body{Eigen::Translation3d(0, 0, kStandingHeight)};  ///< the body's pose in the scene (scene.h)
};

class PictureSource {
 public:
  virtual ~PictureSource() = default;

  /// @param seconds since the robot was switched on
  /// @param image_number selects the noise
  /// @return the picture, valid until the next call
  virtual const YCrCbImage& picture(const CameraPose& pose, double seconds, longword image_number,
                                    const CameraSettings& settings) = 0;
};

/// Frames are OPEN-R frames of 8 ms since the robot was switched on. The class is not thread-safe.
///
/// A picture is drawn when an object first reads its pixels (filled_on_read.h), so an unread image costs almost
/// nothing. The picture shows the moment at which it was taken.
class Camera {
 public:
  /// @param source must outlive the camera
  /// @param id the number of the camera's primitive
  Camera(PictureSource& source, OPrimitiveID id);

  /// True once for each image, in its frame or at the next call. Images without a call are counted, too.
  /// @param frame not before that of the previous call
  bool imageDue(longword frame);

  /// Takes an image and detects its colours. Only the camera refers to the image's region (region_pool.h). Its pixels
  /// must not be read after the camera has been destroyed.
  RCRegion* capture(longword frame, const CameraPose& pose = CameraPose());

  /// Carries out OPENR::ControlPrimitive().
  /// @param param, param_size an OPrimitiveControl_CameraParam for SET requests; otherwise ignored
  /// @return oSUCCESS, or oINVALID_ARG if the request is unknown, the parameter is missing or has a wrong size, or the
  ///   setting does not have the value; in that case nothing changes
  OStatus control(OPrimitiveRequest request, const void* param, size_t param_size);

  const CameraSettings& settings() const { return settings_; }

  ColorDetection& colors() { return colors_; }

  /// Restores the first settings and clears the colours to detect.
  void reset();

 private:
  PictureSource& source_;
  CameraSettings settings_;
  ColorDetection colors_;
  longword images_seen_ = 0;
  RegionPool regions_;
  std::map<const RCRegion*, openr_host::FilledOnRead> images_;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_CAMERA_H
