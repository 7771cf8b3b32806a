/// @file colors.h
/// The colour detection of the robot's camera: which colours to detect, and what was detected. A server of version 1
/// cannot detect colours.
#ifndef AIBO_CLIENT_COLORS_H
#define AIBO_CLIENT_COLORS_H

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace aibo_client {

/// A camera has at most this many channels, each with its own table. An ERS-7 can use 0..6, an ERS-210 0..7.
constexpr int kMostColorChannels = 8;

/// A table has a segment for each 8 values of Y, from dark to bright.
constexpr int kColorSegments = 32;

/// Ranges of Cr and Cb, both ends included, 0..255; 128 is grey. Y, Cr and Cb are those of JPEG files (ITU-R BT.601,
/// full range).
struct ColorRange {
  int cr_min;
  int cr_max;
  int cb_min;
  int cb_max;

  bool operator==(const ColorRange& other) const {
    return cr_min == other.cr_min && cr_max == other.cr_max && cb_min == other.cb_min && cb_max == other.cb_max;
  }
};

/// The colours that a channel detects.
///
/// @code
/// auto pink = std::make_shared<aibo_client::ColorTable>();
/// pink->name = "pink";
/// pink->segments.fill(aibo_client::ColorRange{150, 200, 110, 150});
/// robot.setColorTable(0, pink);
/// robot.setColorDetection({true, 1, false});
/// @endcode
struct ColorTable {
  std::string name;
  /// A segment without a range has no colours. To the robot, a range of 128 to 128 for both Cr and Cb means the same.
  std::array<std::optional<ColorRange>, kColorSegments> segments{};
};

using ColorTablePtr = std::shared_ptr<const ColorTable>;

/// Selects what the robot should send.
struct ColorDetection {
  bool on = false;
  int every_nth_image = 1;  ///< 1..65535; 1 means every image of the camera
  bool with_mask = false;   ///< true: also send which pixels were detected, not only how many and where

  bool operator==(const ColorDetection& other) const {
    return on == other.on && every_nth_image == other.every_nth_image && with_mask == other.with_mask;
  }
  bool operator!=(const ColorDetection& other) const { return !(*this == other); }
};

/// All pixels that a channel has detected in an image, connected or not. Coordinates are in pixels of the plane in
/// which the camera detects colours, from the plane's upper left corner.
struct DetectedRegion {
  int channel = 0;
  std::string name;     ///< the name of the channel's table
  unsigned pixels = 0;  ///< if this is 0, everything below is 0
  double x = 0;         ///< the mean of the pixels' columns; 0 is the middle of the first column
  double y = 0;         ///< the mean of the pixels' rows; 0 is the middle of the first row
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
};

/// The colours that were detected in one image.
struct DetectedColors {
  std::uint32_t frame_number = 0;                 ///< the OPEN-R frame (8 ms) in which the image was taken
  std::uint32_t image_count = 0;                  ///< the camera's own count, as in Picture
  std::chrono::steady_clock::time_point arrival;  ///< when the first byte was read
  std::uint64_t connection_number = 0;            ///< as in Telemetry
  int width = 0;  ///< the width of the plane: 104x80 (ERS-210: 88x72), half of Resolution::kHigh
  int height = 0;
  std::vector<DetectedRegion> regions;  ///< one for each channel that has a table, by ascending channel
  /// The mask, row by row. Each pixel is a byte with one bit for each channel that has detected it; channel 0 is the
  /// lowest bit. The mask is empty unless it was asked for.
  std::vector<std::uint8_t> mask;
};

}  // namespace aibo_client

#endif  // AIBO_CLIENT_COLORS_H
