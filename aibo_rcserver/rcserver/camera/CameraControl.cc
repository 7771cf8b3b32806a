#include "rcserver/camera/CameraControl.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OPrimitiveControl.h>
#include <OPENR/OSyslog.h>

using protocol::version2::CameraSetting;

namespace {

// An ERS-7 and an ERS-210 have the same locator (Model Information).
const char LOCATOR[] = "PRM:/r1/c1/c2/c3/i1-FbkImageSensor:F1";
const int CAMERA = 0;

// The requests for each setting. Each automatic mode has one for off and one for on; others take the value.
const OPrimitiveRequest REQUESTS[protocol::version2::NUMBER_OF_CAMERA_SETTINGS][2] = {
    {oprmreqCAM_SET_WHITE_BALANCE, oprmreqCAM_SET_WHITE_BALANCE},
    {oprmreqCAM_SET_GAIN, oprmreqCAM_SET_GAIN},
    {oprmreqCAM_SET_SHUTTER_SPEED, oprmreqCAM_SET_SHUTTER_SPEED},
    {oprmreqCAM_AE_OFF, oprmreqCAM_AE_ON},
    {oprmreqCAM_AWB_OFF, oprmreqCAM_AWB_ON}};

}  // namespace

CameraControl::CameraControl() : settings_(protocol::version2::defaultCameraSettings()) {}

bool CameraControl::Open() {
  return camera_.IsOpen(CAMERA) || camera_.Open(CAMERA, "camera", LOCATOR);
}

OPrimitiveID CameraControl::Id() const {
  return camera_.Id(CAMERA);
}

bool CameraControl::Set(CameraSetting setting, unsigned char value) {
  if (!Open() || !Command(setting, value)) {
    return false;
  }
  settings_.values[setting - 1] = value;
  return true;
}

void CameraControl::ClientGone() {
  const protocol::version2::CameraSettings at_start = protocol::version2::defaultCameraSettings();
  for (int i = protocol::version2::NUMBER_OF_CAMERA_SETTINGS; i > 0; --i) {
    if (settings_.values[i - 1] != at_start.values[i - 1]) {
      Set(static_cast<CameraSetting>(i), at_start.values[i - 1]);
    }
  }
}

bool CameraControl::Command(CameraSetting setting, unsigned char value) {
  OPrimitiveControl_CameraParam param(value);
  const bool is_automatic = setting >= protocol::version2::SETTING_AUTO_EXPOSURE;
  const OPrimitiveRequest request = REQUESTS[setting - 1][value != 0 ? 1 : 0];
  const OStatus status = is_automatic ? OPENR::ControlPrimitive(Id(), request, NULL, 0, NULL, 0)
                                      : OPENR::ControlPrimitive(Id(), request, &param, sizeof(param), NULL, 0);
  if (status != oSUCCESS) {
    OSYSLOG1((osyslogERROR, "RCServer: the camera does not take the value %d of its setting %d (status %u)",
              static_cast<int>(value), static_cast<int>(setting), static_cast<unsigned>(status)));
  }
  return status == oSUCCESS;
}
