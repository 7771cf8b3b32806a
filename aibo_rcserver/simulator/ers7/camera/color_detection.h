/// @file color_detection.h
/// The camera's colour detection, which tells for each pixel which channels' tables contain its colour.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_COLOR_DETECTION_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_COLOR_DETECTION_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>

#include <array>
#include <cstddef>

namespace simulated_ers7 {

/// How many pixels each channel has found.
using ColorCounts = std::array<std::size_t, ocdtNUM_CHANNELS>;

/// A pixel belongs to a channel if its Cr and Cb are within the ranges of the segment for its Y, both ends included.
/// There is a segment for each 8 values of Y, and one with 128 for all four ends contains nothing (Sony's program
/// cdt2bmp, of the sample ImageObserver).
class ColorDetection {
 public:
  ColorDetection() { clear(); }

  /// Replaces the tables of the channels named, after all of them have been checked.
  /// @return oINVALID_ARG if a channel is not one of the channels 0-6 of an ERS-7 (Model Information ERS-7, section
  ///         3.2.1)
  OStatus load(const OCdtVectorData& tables);

  /// Empties all tables.
  void clear();

  /// False if all tables are empty, so that nothing can be detected.
  bool isOn() const { return is_on_; }

  /// Detects colours in a row of pixels.
  /// @param[out] pixels a byte for each, with a bit for each channel (ocdtCHANNEL0 and so on)
  /// @param[in,out] counts the row's are added
  void detect(const byte* y, const byte* cr, const byte* cb, std::size_t width, byte* pixels,
              ColorCounts* counts) const;

 private:
  /// The channels that contain a value of Cr, or of Cb, in each segment.
  using Channels = std::array<std::array<byte, 256>, ocdtMAX_Y_SEGMENT>;

  void loadChannel(const OCdtInfo& table);

  Channels with_cr_;
  Channels with_cb_;
  bool is_on_;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_COLOR_DETECTION_H
