/// @file photo_show.h
/// A folder of photographs instead of the scene.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_PHOTO_SHOW_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_PHOTO_SHOW_H

#include <string>
#include <vector>

#include "simulator/ers7/camera/picture_source.h"

namespace simulated_ers7 {

/// Shows the photographs of a folder in the order of their names, one after the other, and then again. They are shown
/// as they are: without noise, whatever the camera's settings and wherever the head looks.
class PhotoShow : public PictureSource {
 public:
  /// Reads all photographs (photograph.h) of the folder, not of its subfolders, other files left alone.
  /// @param seconds_per_picture how long each is shown, above 0
  /// @throw PhotographError if there is no such folder, no photograph in it, or one that cannot be read
  PhotoShow(const std::string& folder, double seconds_per_picture);

  void setHead(const HeadAngles& /*angles*/) override {}
  void setBody(const Eigen::Isometry3d& /*in_room*/) override {}
  const YCrCbImage& picture(double seconds, longword image_number, const CameraSettings& settings) override;

 private:
  std::vector<YCrCbImage> pictures_;
  double seconds_per_picture_;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_PHOTO_SHOW_H
