/// Version 2's request `G`: the camera's settings.
#ifndef AIBO_RCSERVER_PROTOCOL_CAMERA_SETTINGS_H
#define AIBO_RCSERVER_PROTOCOL_CAMERA_SETTINGS_H

#include <stddef.h>

#include "protocol/request.h"

namespace protocol {
namespace version2 {

const char REQUEST_CAMERA = 'G';  ///< sets or reads a camera setting; the reply has its value
const Request SET_CAMERA = {REQUEST_CAMERA, "set its camera", 0, NULL};

/// A setting of the camera: the id of `G` and its reply.
enum CameraSetting {
  SETTING_WHITE_BALANCE = 1,      ///< 1 indoor, 2 outdoor, 3 fluorescent lamps
  SETTING_GAIN = 2,               ///< 1 low, 2 mid, 3 high
  SETTING_SHUTTER_SPEED = 3,      ///< 1 slow, 2 mid, 3 fast
  SETTING_AUTO_EXPOSURE = 4,      ///< 0 off, 1 on
  SETTING_AUTO_WHITE_BALANCE = 5  ///< 0 off, 1 on
};

const int NUMBER_OF_CAMERA_SETTINGS = 5;

/// All settings, with OPEN-R's values (OPENR/OPrimitiveControl.h).
struct CameraSettings {
  /// The value of each setting, at the index id - 1. If all are 0, the settings are unknown.
  unsigned char values[NUMBER_OF_CAMERA_SETTINGS];

  unsigned char of(CameraSetting setting) const { return values[setting - 1]; }
  bool areKnown() const { return values[0] != 0; }
};

/// The settings when the camera starts: fluorescent lamps (5000 K), 0 dB, 1/100 s, nothing automatic (Sony, Model
/// Information ERS-7, section 3.2.1).
CameraSettings defaultCameraSettings();

/// What is wrong with this value for this setting, or NULL. Every setting allows the value 1.
const char* problemOfCameraValue(int id, int value);

/// Payload of `G` and its reply. An empty request reads the setting.
struct CameraValue {
  unsigned char id;  ///< a CameraSetting. It is the frame's id, not in the payload: set it before decoding
  unsigned char value;

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(value);
    const char* const problem = problemOfCameraValue(id, value);
    fields.require(problem == NULL, problem);
  }
};

/// All settings in the last 16 bits of an image header; 0 means unknown.
unsigned short packCameraSettings(const CameraSettings& settings);

/// @return NULL, or what is wrong; in that case the settings are unchanged
const char* unpackCameraSettings(unsigned short packed, CameraSettings* settings);

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_CAMERA_SETTINGS_H
