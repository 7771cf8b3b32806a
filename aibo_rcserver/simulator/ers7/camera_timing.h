/// @file camera_timing.h
/// When the camera has an image ready.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_TIMING_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_TIMING_H

#include <OPENR/OPENR.h>

#include <cstdint>

namespace simulated_ers7 {

/// Length of an OPEN-R frame in seconds.
constexpr double kFrameSeconds = 0.008;

/// The camera runs on its own clock, 29.88 images per second, and is looked at every 8 ms: most images come 32 ms
/// after the one before, some 40 ms. 60 images in 251 frames is the mean of 33.47 ms that was measured on an ERS-7
/// (Tekkotsu, profilerun_ERS7_2.0).
///
/// @return how many images the camera has finished up to and including an OPEN-R frame, the first in frame 0
constexpr longword imagesUpTo(longword frame) {
  constexpr std::uint64_t kImages = 60;
  constexpr std::uint64_t kFrames = 251;
  return static_cast<longword>(frame * kImages / kFrames + 1);
}

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_TIMING_H
