#include "simulator/ers7/camera/camera_settings.h"

#include <cstring>

namespace simulated_ers7 {
namespace {

/// All three settings have the values 1, 2 and 3.
OStatus choose(const void* param, size_t param_size, longword* setting) {
  longword value = 0;
  if (param == nullptr || param_size != sizeof(OPrimitiveControl_CameraParam)) {
    return oINVALID_ARG;
  }
  std::memcpy(&value, param, sizeof(value));
  if (value < 1 || value > 3) {
    return oINVALID_ARG;
  }
  *setting = value;
  return oSUCCESS;
}

OStatus turn(bool on, bool* setting) {
  *setting = on;
  return oSUCCESS;
}

}  // namespace

OStatus controlCamera(OPrimitiveRequest request, const void* param, size_t param_size, CameraSettings* settings) {
  switch (request) {
    case oprmreqCAM_SET_WHITE_BALANCE:
      return choose(param, param_size, &settings->white_balance);
    case oprmreqCAM_SET_GAIN:
      return choose(param, param_size, &settings->gain);
    case oprmreqCAM_SET_SHUTTER_SPEED:
      return choose(param, param_size, &settings->shutter);
    case oprmreqCAM_AE_ON:
    case oprmreqCAM_AE_OFF:
      return turn(request == oprmreqCAM_AE_ON, &settings->auto_exposure);
    case oprmreqCAM_AWB_ON:
    case oprmreqCAM_AWB_OFF:
      return turn(request == oprmreqCAM_AWB_ON, &settings->auto_white_balance);
    default:
      return oINVALID_ARG;
  }
}

}  // namespace simulated_ers7
