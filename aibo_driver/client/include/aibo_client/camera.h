/// @file camera.h
/// The robot's camera: its settings, its stream, and its pictures. A server that speaks version 1 of the protocol has
/// no settings: see RcServerClient.
#ifndef AIBO_CLIENT_CAMERA_H
#define AIBO_CLIENT_CAMERA_H

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <tuple>
#include <vector>

namespace aibo_client {

/// The sizes of the pictures. Three are layers of the camera; the robot puts the fourth together. The sizes are those
/// of an ERS-7 and, in parentheses, of an ERS-210.
enum class Resolution {
  kHigh = 0,    ///< 208x160 (176x144)
  kMiddle = 1,  ///< 104x80 (88x72)
  kLow = 2,     ///< 52x40 (44x36)
  kDouble = 3   ///< 416x320, if the camera has the bands for it; several times the work for the robot
};

/// How the pictures of the stream come. Everything else always comes by TCP, even a picture for takePicture().
enum class PictureTransport {
  kTcp,  ///< each picture comes whole; one that has lost a packet comes late and delays the pictures behind it
  /// A lost packet delays its picture by a few milliseconds, or the picture is lost; no other picture waits. Where
  /// datagrams do not get through, the pictures come by TCP. The client tests this before it changes to UDP. If the
  /// test fails, it tests again every 10 s (our choice).
  kUdp
};

/// Selects the pictures of the stream.
struct StreamFormat {
  Resolution resolution = Resolution::kHigh;
  /// 1..65535; 1 means every image. An ERS-7's camera takes 30 images a second, an ERS-210's 25.
  int every_nth_image = 1;

  bool operator==(const StreamFormat& other) const {
    return resolution == other.resolution && every_nth_image == other.every_nth_image;
  }
  bool operator!=(const StreamFormat& other) const { return !(*this == other); }
};

/// The camera's settings, with Sony's numbers. The defaults are the settings of the camera when the robot starts (Sony,
/// Model Information ERS-7, section 3.2.1).
struct CameraSettings {
  int white_balance = 3;            ///< 1 indoor (2856 K), 2 outdoor (6500 K), 3 fluorescent lamps (5000 K)
  int gain = 2;                     ///< 1 low (-6 dB), 2 mid (0 dB), 3 high (+6 dB)
  int shutter_speed = 2;            ///< 1 slow (1/50 s), 2 mid (1/100 s), 3 fast (1/200 s)
  bool auto_exposure = false;       ///< true: the camera chooses gain and shutter speed
  bool auto_white_balance = false;  ///< true: the camera chooses the white balance

  bool operator==(const CameraSettings& other) const { return tied() == other.tied(); }
  bool operator!=(const CameraSettings& other) const { return !(*this == other); }

 private:
  std::tuple<int, int, int, bool, bool> tied() const {
    return {white_balance, gain, shutter_speed, auto_exposure, auto_white_balance};
  }
};

/// One picture as the robot sent it. It never changes after delivery, so threads may share it.
struct Picture {
  std::vector<std::uint8_t> jpeg;  ///< the robot's bytes, without the protocol's header
  /// When the first byte of the picture's header arrived. Pictures that arrived together are 1 ns apart, in order.
  std::chrono::steady_clock::time_point first_byte_time;
  int width = 0;                        ///< pixels, from the JPEG's own frame header
  int height = 0;                       ///< pixels, from the JPEG's own frame header
  int quality = 0;                      ///< 1..100, as requested; a server of version 1 does not confirm it
  std::uint64_t connection_number = 0;  ///< the number of the connection; the client's first one is 1

  // A version 1 server does not send the following members.
  std::optional<std::uint32_t> frame_number;  ///< the OPEN-R frame (8 ms) in which the camera took the image
  std::optional<std::uint32_t> image_count;   ///< the camera's own count of images
  std::optional<CameraSettings> settings;     ///< in force for the image; some servers do not send them
};

using PicturePtr = std::shared_ptr<const Picture>;

}  // namespace aibo_client

#endif  // AIBO_CLIENT_CAMERA_H
