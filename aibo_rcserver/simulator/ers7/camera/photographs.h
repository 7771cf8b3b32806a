/// @file photographs.h
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_PHOTOGRAPHS_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_PHOTOGRAPHS_H

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "simulator/ers7/camera/camera.h"
#include "simulator/ers7/camera/ycrcb_image.h"

namespace simulated_ers7 {

/// Thrown if a photograph cannot be used. The text names the file or folder, the reason and a remedy.
class PhotographError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads a JPEG of up to 100 million pixels, crops it evenly to the shape of the camera's picture, and scales it.
/// @throw PhotographError the file cannot be read, or is damaged or of another format
YCrCbImage readPhotograph(const std::filesystem::path& file);

/// Shows a folder's photographs in an endless loop, in the order of their names, each for kSeconds. The pictures have
/// no noise. The camera's settings and the head have no effect.
class PhotoShow : public PictureSource {
 public:
  static constexpr double kSeconds = 2;

  /// Reads the folder, but neither subfolders nor files that do not end in .jpg or .jpeg, in lower or upper case.
  /// @throw PhotographError there is no such folder or no photograph in it, or a photograph cannot be read
  explicit PhotoShow(const std::string& folder);

  const YCrCbImage& picture(const CameraPose& pose, double seconds, longword image_number,
                            const CameraSettings& settings) override;

 private:
  std::vector<YCrCbImage> pictures_;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_PHOTOGRAPHS_H
