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

/// Pictures cannot be had. The text names the file or folder, and says why and what to do.
class PhotographError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// True for the endings .jpg, .jpeg and .ppm, in small or capital letters.
bool isPhotographName(const std::filesystem::path& file);

/// Reads a JPEG or a binary PPM (P6, 8 bits) of any size up to 100 million pixels. Cuts off, evenly on both sides,
/// what is wider or higher than the camera's picture, and scales the rest by averaging.
/// @throw PhotographError for a file that cannot be read, is no such picture, or is damaged
YCrCbImage readPhotograph(const std::filesystem::path& file);

/// Shows the photographs of a folder in the order of their names, one after the other, and then again. They are shown
/// as they are: without noise, whatever the camera's settings and wherever the head looks.
class PhotoShow : public PictureSource {
 public:
  /// Reads all photographs of the folder, not of its subfolders, other files left alone.
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

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_PHOTOGRAPHS_H
