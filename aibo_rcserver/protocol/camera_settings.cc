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

bool hasCameraValue(int id, int value) {
  return id >= 1 && id <= NUMBER_OF_CAMERA_SETTINGS && value >= LOWEST[id - 1] && value <= HIGHEST[id - 1];
}

size_t encodeCameraValue(unsigned char value, unsigned char* out) {
  out[0] = value;
  return CAMERA_VALUE_SIZE;
}

const char* decodeCameraValue(int id, const unsigned char* payload, size_t size, unsigned char* value) {
  if (id < 1 || id > NUMBER_OF_CAMERA_SETTINGS) {
    return "the id is not that of a camera setting (1 white balance, 2 gain, 3 shutter speed, 4 automatic exposure, 5 "
           "automatic white balance)";
  }
  if (size != CAMERA_VALUE_SIZE) {
    return "the payload has the wrong size";
  }
  if (!hasCameraValue(id, payload[0])) {
    return id < SETTING_AUTO_EXPOSURE ? "the camera setting has no value but 1, 2 and 3"
                                      : "the automatic mode is neither off (0) nor on (1)";
  }
  *value = payload[0];
  return NULL;
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
