/// @file camera_options.h
#ifndef AIBO_DRIVER_CAMERA_CAMERA_OPTIONS_H
#define AIBO_DRIVER_CAMERA_CAMERA_OPTIONS_H

#include <optional>
#include <string>

#include "aibo_client/camera.h"
#include "aibo_client/status.h"

namespace aibo_driver::camera {

/// The images per second of an ERS-7's camera (Sony, Model Information ERS-7, section 3.2.1).
constexpr double kCameraRate = 30.0;

/// The lowest rate of a stream. With one picture a second or less, the stream would look like a broken one.
constexpr double kLowestFrameRate = 2.0;

/// The highest quality of a JPEG (section 3.3.6 of the report that README.md names).
constexpr int kMaxQuality = 100;

/// The resolutions that users may write, for messages.
constexpr const char* kResolutionNames = "52x40, 104x80, 208x160 or 416x320";

/// @param name one of kResolutionNames, also for an ERS-210, whose pictures are a little smaller
/// @return empty for any other text
std::optional<aibo_client::Resolution> resolutionOf(const std::string& name);

/// The transports that users may write for the stream's pictures, for messages.
constexpr const char* kTransportNames = "tcp or udp";

/// @param name one of kTransportNames
/// @return empty for any other text
std::optional<aibo_client::PictureTransport> transportOf(const std::string& name);

/// The name of a transport.
const char* nameOf(aibo_client::PictureTransport transport);

/// Why the pictures of the stream come as they do. It is empty while there is no connection.
std::string transportReason(const aibo_client::ConnectionStatus& status);

/// The nearest rate at which the camera can send pictures at even intervals.
/// @param rate pictures per second, kLowestFrameRate..kCameraRate
/// @return 1 for every image, 2 for every second image, and so on, up to 15
int everyNthImageOf(double rate);

/// The pictures per second of a stream that sends every nth image.
double frameRateOf(int every_nth_image);

}  // namespace aibo_driver::camera

#endif  // AIBO_DRIVER_CAMERA_CAMERA_OPTIONS_H
