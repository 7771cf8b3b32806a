/// @file photograph.h
/// Reads photographs from files, made to fit the camera.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_PHOTOGRAPH_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_PHOTOGRAPH_H

#include <filesystem>
#include <stdexcept>

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

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_PHOTOGRAPH_H
