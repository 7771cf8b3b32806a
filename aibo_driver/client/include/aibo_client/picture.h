/// @file picture.h
#ifndef AIBO_CLIENT_PICTURE_H
#define AIBO_CLIENT_PICTURE_H

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "aibo_client/camera.h"

namespace aibo_client {

/// One picture as the robot sent it. It never changes after delivery, so threads may share it.
struct Picture {
  std::vector<std::uint8_t> jpeg;  ///< the robot's bytes, without the protocol's header
  /// When the first byte of the picture's header arrived. Pictures that arrived together are 1 ns apart, in order.
  std::chrono::steady_clock::time_point first_byte_time;
  int width = 0;                        ///< pixels, from the JPEG's own frame header
  int height = 0;                       ///< pixels, from the JPEG's own frame header
  std::uint64_t connection_number = 0;  ///< the number of the connection; the client's first one is 1

  // A version 1 server does not send the following members.
  std::optional<std::uint32_t> frame_number;  ///< the OPEN-R frame (8 ms) in which the camera took the image
  std::optional<std::uint32_t> image_count;   ///< the camera's own count of images
  std::optional<CameraSettings> settings;     ///< in force for the image; some servers do not send them
};

using PicturePtr = std::shared_ptr<const Picture>;

}  // namespace aibo_client

#endif  // AIBO_CLIENT_PICTURE_H
