/// @file camera.h
/// What the robot's camera can be asked for. A server that speaks version 1 of the protocol has none of it: see
/// RcServerClient.
#ifndef AIBO_DRIVER_CAMERA_H
#define AIBO_DRIVER_CAMERA_H

#include <tuple>

namespace aibo_driver {

/// The sizes of the pictures: three layers of the camera, and one that the robot puts together. The sizes are those of
/// an ERS-7 and, in parentheses, of an ERS-210.
enum class Resolution {
  kHigh = 0,    ///< 208x160 (176x144)
  kMiddle = 1,  ///< 104x80 (88x72)
  kLow = 2,     ///< 52x40 (44x36)
  kDouble = 3   ///< 416x320, if the camera has the bands for it; several times the work for the robot
};

/// How the pictures of the stream come. All else comes by TCP in any case, also a picture for takePicture().
enum class PictureTransport {
  kTcp,  ///< each comes whole; one that has lost a packet comes late, and so do those behind it
  kUdp   ///< one that has lost a packet does not come, and delays no other
};

/// Which pictures the stream has.
struct StreamFormat {
  Resolution resolution = Resolution::kHigh;
  int every_nth_image = 1;  ///< of the camera, 1..65535; an ERS-7's takes 30 images a second, an ERS-210's 25

  bool operator==(const StreamFormat& other) const {
    return resolution == other.resolution && every_nth_image == other.every_nth_image;
  }
  bool operator!=(const StreamFormat& other) const { return !(*this == other); }
};

/// The camera's settings, with Sony's numbers. The defaults are those of the camera when the robot starts (Sony, Model
/// Information ERS-7, section 3.2.1).
struct CameraSettings {
  int white_balance = 3;            ///< 1 indoor (2856 K), 2 outdoor (6500 K), 3 fluorescent lamps (5000 K)
  int gain = 2;                     ///< 1 low (-6 dB), 2 mid (0 dB), 3 high (+6 dB)
  int shutter_speed = 2;            ///< 1 slow (1/50 s), 2 mid (1/100 s), 3 fast (1/200 s)
  bool auto_exposure = false;       ///< the camera chooses gain and shutter speed
  bool auto_white_balance = false;  ///< the camera chooses the white balance

  bool operator==(const CameraSettings& other) const { return tied() == other.tied(); }
  bool operator!=(const CameraSettings& other) const { return !(*this == other); }

 private:
  std::tuple<int, int, int, bool, bool> tied() const {
    return {white_balance, gain, shutter_speed, auto_exposure, auto_white_balance};
  }
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CAMERA_H
