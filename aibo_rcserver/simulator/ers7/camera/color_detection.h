/// @file color_detection.h
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_COLOR_DETECTION_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_COLOR_DETECTION_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>

#include <array>
#include <cstddef>

namespace simulated_ers7 {

/// How many pixels each channel has found.
using ColorCounts = std::array<std::size_t, ocdtNUM_CHANNELS>;

/// Finds for each pixel the channels whose tables contain its colour. A pixel belongs to a channel if Cr and Cb are
/// within the ranges of the segment for its Y, both ends included. Each segment covers 8 values of Y. A segment of four
/// times 128 is empty (Sony's program cdt2bmp in the sample ImageObserver).
class ColorDetection {
 public:
  ColorDetection() { clear(); }

  /// Checks all tables, then replaces those of the named channels.
  /// @return oINVALID_ARG if the ERS-7 lacks a channel; it has channels 0 to 6 (Model Information ERS-7, section 3.2.1)
  OStatus load(const OCdtVectorData& tables);

  void clear();

  /// False if all tables are empty.
  bool isOn() const { return is_on_; }

  /// Detects colours in a row of pixels.
  /// @param[out] pixels one byte for each pixel, with a bit for each channel (ocdtCHANNEL0 and so on)
  /// @param[in,out] counts increased by the row's counts
  void detect(const byte* y, const byte* cr, const byte* cb, std::size_t width, byte* pixels,
              ColorCounts* counts) const;

 private:
  /// For each segment and each value of Cr or Cb, the channels whose range contains the value.
  using Channels = std::array<std::array<byte, 256>, ocdtMAX_Y_SEGMENT>;

  void loadChannel(const OCdtInfo& table);

  Channels with_cr_;
  Channels with_cb_;
  bool is_on_;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_COLOR_DETECTION_H
