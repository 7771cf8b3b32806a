/// @file camera_settings.h
/// Version 2's request `G`: what the camera is set to. Decoders and encoders follow the rules in version2.h.
#ifndef AIBO_RCSERVER_PROTOCOL_CAMERA_SETTINGS_H
#define AIBO_RCSERVER_PROTOCOL_CAMERA_SETTINGS_H

#include <stddef.h>

namespace protocol {
namespace version2 {

/// A setting of the camera: the id of `G` and of its reply.
enum CameraSetting {
  SETTING_WHITE_BALANCE = 1,      ///< 1 indoor, 2 outdoor, 3 fluorescent lamps
  SETTING_GAIN = 2,               ///< 1 low, 2 mid, 3 high
  SETTING_SHUTTER_SPEED = 3,      ///< 1 slow, 2 mid, 3 fast
  SETTING_AUTO_EXPOSURE = 4,      ///< 0 off, 1 on
  SETTING_AUTO_WHITE_BALANCE = 5  ///< 0 off, 1 on
};

const int NUMBER_OF_CAMERA_SETTINGS = 5;

/// All settings, with values as OPEN-R numbers them (OPENR/OPrimitiveControl.h).
struct CameraSettings {
  /// By id - 1; all 0: they are not known.
  unsigned char values[NUMBER_OF_CAMERA_SETTINGS];

  unsigned char of(CameraSetting setting) const { return values[setting - 1]; }
  bool areKnown() const { return values[0] != 0; }
};

/// As the camera starts: fluorescent lamps (5000 K), 0 dB, 1/100 s, nothing automatic (Sony, Model Information ERS-7,
/// section 3.2.1).
CameraSettings defaultCameraSettings();

/// True if this is the id of a setting that has this value.
bool hasCameraValue(int id, int value);

/// Payload of `G` and of its reply: uint8 value. An empty request reads the setting.
const size_t CAMERA_VALUE_SIZE = 1;
size_t encodeCameraValue(unsigned char value, unsigned char* out);
/// The decoder for one setting, the id of the frame.
const char* decodeCameraValue(int id, const unsigned char* payload, size_t size, unsigned char* value);

/// All settings in the 16 bits at the end of an image header: two bits each for white balance, gain and shutter speed,
/// from the lowest bit up, then one bit for each automatic mode. 0: they are not known.
unsigned short packCameraSettings(const CameraSettings& settings);

/// @return NULL, or what is wrong; then the result is unchanged
const char* unpackCameraSettings(unsigned short packed, CameraSettings* settings);

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_CAMERA_SETTINGS_H
