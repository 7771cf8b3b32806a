#include "protocol/camera_settings.h"

namespace protocol {
namespace version2 {
namespace {

const unsigned char LOWEST[NUMBER_OF_CAMERA_SETTINGS] = {1, 1, 1, 0, 0};
const unsigned char HIGHEST[NUMBER_OF_CAMERA_SETTINGS] = {3, 3, 3, 1, 1};
const int BITS[NUMBER_OF_CAMERA_SETTINGS] = {2, 2, 2, 1, 1};

}  // namespace

CameraSettings defaultCameraSettings() {
  const CameraSettings settings = {{3, 2, 2, 0, 0}};
  return settings;
}

const char* problemOfCameraValue(int id, int value) {
  if (id < 1 || id > NUMBER_OF_CAMERA_SETTINGS) {
    return "no camera setting has this id (1 white balance, 2 gain, 3 shutter speed, 4 automatic exposure, 5 "
           "automatic white balance)";
  }
  if (value >= LOWEST[id - 1] && value <= HIGHEST[id - 1]) {
    return NULL;
  }
  return id < SETTING_AUTO_EXPOSURE ? "the camera setting must be 1, 2 or 3"
                                    : "the automatic mode is neither off (0) nor on (1)";
}

unsigned short packCameraSettings(const CameraSettings& settings) {
  unsigned packed = 0;
  for (int i = NUMBER_OF_CAMERA_SETTINGS; i-- > 0;) {
    packed = packed << BITS[i] | settings.values[i];
  }
  return static_cast<unsigned short>(packed);
}

const char* unpackCameraSettings(unsigned short packed, CameraSettings* settings) {
  unsigned rest = packed;
  CameraSettings unpacked;
  for (int i = 0; i < NUMBER_OF_CAMERA_SETTINGS; ++i) {
    unpacked.values[i] = static_cast<unsigned char>(rest & ((1U << BITS[i]) - 1));
    if (packed != 0 && unpacked.values[i] < LOWEST[i]) {
      return "a camera setting has no value";
    }
    rest >>= BITS[i];
  }
  if (rest != 0) {
    return "a reserved bit is not 0";
  }
  *settings = unpacked;
  return NULL;
}

}  // namespace version2
}  // namespace protocol
