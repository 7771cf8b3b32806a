/// @file photographs.h
/// Photographs for the camera to show instead of the scene.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_PHOTOGRAPHS_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_PHOTOGRAPHS_H

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "simulator/ers7/camera/camera.h"
#include "simulator/ers7/camera/ycrcb_image.h"

namespace simulated_ers7 {

/// Photographs cannot be shown. The text names the file or folder, the reason and a remedy.
class PhotographError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// True for the extensions .jpg, .jpeg and .ppm, in small or capital letters.
bool isPhotographName(const std::filesystem::path& file);

/// Reads a JPEG or a binary PPM (P6, 8 bits) of up to 100 million pixels. Crops it evenly on both sides to the shape of
/// the camera's picture, and scales it by averaging.
/// @throw PhotographError for a file that cannot be read, is not such a picture, or is damaged
YCrCbImage readPhotograph(const std::filesystem::path& file);

/// Shows the photographs in a folder again and again, in the order of their names. They have no noise, and do not
/// depend on the camera's settings and the head's direction.
class PhotoShow : public PictureSource {
 public:
  /// Reads all photographs in the folder, but not in its subfolders. Other files are ignored.
  /// @param seconds_per_picture how long each is shown, above 0
  /// @throw PhotographError if there is no such folder, no photograph in it, or one that cannot be read
  PhotoShow(const std::string& folder, double seconds_per_picture);

  void setHead(const HeadAngles& /*angles*/) override {}
  void setBody(const Eigen::Isometry3d& /*in_room*/) override {}
  const YCrCbImage& picture(double seconds, longword image_number, const CameraSettings& settings) override;
  bool hasConstantPictures() const override { return true; }

 private:
  std::vector<YCrCbImage> pictures_;
  double seconds_per_picture_;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_PHOTOGRAPHS_H
