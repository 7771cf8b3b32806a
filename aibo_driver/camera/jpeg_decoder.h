/// @file jpeg_decoder.h
/// Decodes JPEG to pixels, without ROS.
#ifndef AIBO_DRIVER_CAMERA_JPEG_DECODER_H
#define AIBO_DRIVER_CAMERA_JPEG_DECODER_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "aibo_client/exceptions.h"

namespace aibo_driver::camera {

/// Thrown if the bytes are not a whole, undamaged picture of the robot's camera. The message says what is wrong.
class DecodeException : public aibo_client::Exception {
 public:
  using Exception::Exception;
};

/// The rows go from top to bottom without padding. A pixel has three bytes: blue, green, red.
struct BgrImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;  ///< 3 * width * height
};

/// Decodes one of the robot's pictures. Any thread may call it.
///
/// A picture that inspectJpeg() rejects is refused before any memory is allocated for it, so a hostile picture costs no
/// more time than a good one. A warning of the decoder counts as an error, because half a picture with grey blocks is
/// worse than none.
/// @param jpeg not null unless size is 0
/// @throw DecodeException the picture is damaged, the camera cannot have made it, or there is no memory
BgrImage decodeJpeg(const std::uint8_t* jpeg, std::size_t size);

}  // namespace aibo_driver::camera

#endif  // AIBO_DRIVER_CAMERA_JPEG_DECODER_H
