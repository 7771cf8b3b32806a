/// @file camera_options.h
#ifndef AIBO_DRIVER_ROS_CAMERA_CAMERA_OPTIONS_H
#define AIBO_DRIVER_ROS_CAMERA_CAMERA_OPTIONS_H

#include <optional>
#include <string>

#include "aibo_driver/camera.h"

namespace aibo_driver::node {

/// Images per second of an ERS-7's camera (Sony, Model Information ERS-7, section 3.2.1).
constexpr double kCameraRate = 30.0;

/// The lowest rate of a stream. With one picture in a second or less, the stream could not be told from a broken one.
constexpr double kLowestFrameRate = 2.0;

/// The highest quality of a JPEG (report, section 3.3.6).
constexpr int kMaxQuality = 100;

/// What users may write as a resolution, for messages.
constexpr const char* kResolutionNames = "52x40, 104x80, 208x160 or 416x320";

/// @param name one of kResolutionNames, also for an ERS-210, whose pictures are a little smaller
/// @return none for any other text
std::optional<Resolution> resolutionOf(const std::string& name);

/// What users may write as the transport of the stream's pictures, for messages.
constexpr const char* kTransportNames = "tcp or udp";

/// @param name one of kTransportNames
/// @return none for any other text
std::optional<PictureTransport> transportOf(const std::string& name);

/// The name of a transport.
const char* nameOf(PictureTransport transport);

/// The nearest rate that the camera can keep evenly.
/// @param rate pictures per second, kLowestFrameRate..kCameraRate
/// @return every how many images, 1..15
int everyNthImageOf(double rate);

/// The pictures per second of such a stream.
double frameRateOf(int every_nth_image);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_CAMERA_CAMERA_OPTIONS_H
