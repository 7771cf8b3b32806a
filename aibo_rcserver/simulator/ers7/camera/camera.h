/// @file camera.h
/// The ERS-7's camera: its settings, its timing, and its images in the layout of OPEN-R.
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

/// White balance and shutter start as in Sony's Model Information ERS-7. Gain starts in the middle and both automatic
/// modes are off at first, which is our choice, so that all settings have an effect.
struct CameraSettings {
  longword white_balance = ocamparamWB_FL_MODE;
  longword gain = ocamparamGAIN_MID;
  longword shutter = ocamparamSHUTTER_MID;
  bool auto_exposure = false;       ///< gain and shutter have no effect while it is on
  bool auto_white_balance = false;  ///< white_balance has no effect while it is on
};

/// The number of images that the camera has finished up to and including an OPEN-R frame, the first in frame 0.
///
/// The camera runs on its own clock at 29.88 images per second and is read every 8 ms, so most images come 32 ms after
/// the one before, some 40 ms. 60 images in 251 frames have the mean of 33.47 ms that was measured on an ERS-7
/// (Tekkotsu, profilerun_ERS7_2.0).
constexpr longword imagesUpTo(longword frame) {
  constexpr std::uint64_t kImages = 60;
  constexpr std::uint64_t kFrames = 251;
  return static_cast<longword>(frame * kImages / kFrames + 1);
}

/// The first frame after this one in which the camera finishes an image.
constexpr longword imageAfter(longword frame) {
  longword next = frame + 1;
  while (imagesUpTo(next) == imagesUpTo(frame)) {
    ++next;
  }
  return next;
}

/// Where the robot holds its camera.
struct CameraPose {
  HeadAngles head = restingHead();
  Eigen::Isometry3d body{Eigen::Translation3d(0, 0, kStandingHeight)};  ///< its pose in the scene (scene.h)
};

class PictureSource {
 public:
  virtual ~PictureSource() = default;

  /// Turns the head with the camera. Takes effect with the next picture.
  virtual void setHead(const HeadAngles& angles) = 0;

  /// Moves the body. Takes effect with the next picture.
  /// @param in_room its pose in the scene (scene.h)
  virtual void setBody(const Eigen::Isometry3d& in_room) = 0;

  /// The camera's picture.
  /// @param seconds since the robot was switched on
  /// @param image_number selects the noise, which differs from image to image
  /// @return valid until the next call
  virtual const YCrCbImage& picture(double seconds, longword image_number, const CameraSettings& settings) = 0;

  /// True if no picture ever changes: what is at its address is what was there before.
  virtual bool hasConstantPictures() const { return false; }
};

/// Frames are OPEN-R frames of 8 ms since the robot was switched on. Not thread-safe.
///
/// A picture is drawn when an object first reads its pixels (filled_on_read.h), so an image that nobody looks at costs
/// next to nothing. As long as only Y, Cr and Cb of layer H are read, only these are written. It always shows what
/// there was to see when it was taken.
class Camera {
 public:
  /// @param source draws the pictures; must outlive the camera
  /// @param id the camera's primitive, which its images contain
  Camera(PictureSource& source, OPrimitiveID id);

  /// True once for each image, in its frame or in the next one with a call. Images without a call are counted, too.
  /// @param frame not lower than in the previous call
  bool imageDue(longword frame);

  /// Takes an image, with the colours that are detected in it, in a region to which only the camera refers
  /// (region_pool.h). Its pixels must not be read after the camera's end.
  RCRegion* capture(longword frame, const CameraPose& pose = CameraPose());

  /// Carries out OPENR::ControlPrimitive().
  /// @param param, param_size an OPrimitiveControl_CameraParam for the SET requests; ignored for others
  /// @return oSUCCESS; oINVALID_ARG, with nothing changed, for an unknown request, a parameter that is missing or of
  ///         another size, or a value that the setting does not have
  OStatus control(OPrimitiveRequest request, const void* param, size_t param_size);

  const CameraSettings& settings() const { return settings_; }

  /// The colours that it detects.
  ColorDetection& colors() { return colors_; }

  /// Everything as after switching on: settings, and no colours to detect.
  void reset();

 private:
  /// What an image is taken of, and how.
  struct Exposure {
    longword frame = 0;
    CameraPose pose;
    CameraSettings settings;
    ColorDetection colors;
  };

  /// An image in one of the regions, with the parts that are drawn separately. Objects ask for a band by the address of
  /// its beginning, so the part with Y, Cr and Cb of layer H contains only their beginnings.
  struct Image {
    explicit Image(RCRegion* region_);

    RCRegion* const region;
    Exposure exposure;
    openr_host::FilledOnRead largest_colors;
    openr_host::FilledOnRead others;
    const YCrCbImage* written = nullptr;  ///< the constant picture whose Y, Cr and Cb are in layer H
  };

  void drawLargestColors(Image& image);
  void draw(Image& image);
  const YCrCbImage& pictureOf(const Image& image);

  PictureSource& source_;
  CameraSettings settings_;
  ColorDetection colors_;
  longword images_seen_ = 0;
  RegionPool regions_;
  std::map<const RCRegion*, Image> images_;
  const Image* drawn_ =
      nullptr;  ///< whose picture the source has drawn last; null if that image is not in use any more
  const YCrCbImage* picture_ = nullptr;  ///< of `drawn_`
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_CAMERA_H
