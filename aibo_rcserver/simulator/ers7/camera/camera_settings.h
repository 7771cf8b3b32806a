/// @file camera_settings.h
/// What OPENR::ControlPrimitive() sets on the camera.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_CAMERA_SETTINGS_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_CAMERA_SETTINGS_H

#include <OPENR/OPrimitiveControl.h>

namespace simulated_ers7 {

/// White balance and shutter start as Sony's Model Information ERS-7 says; that gain starts in the middle and both
/// automatics start switched off is our choice, so that all settings show.
struct CameraSettings {
  longword white_balance = ocamparamWB_FL_MODE;
  longword gain = ocamparamGAIN_MID;
  longword shutter = ocamparamSHUTTER_MID;
  bool auto_exposure = false;       ///< gain and shutter count for nothing while it is on
  bool auto_white_balance = false;  ///< white_balance counts for nothing while it is on
};

/// Carries out a request for the camera.
/// @param param, param_size an OPrimitiveControl_CameraParam for the SET requests; not looked at for the others
/// @return oSUCCESS; oINVALID_ARG, with nothing changed, for an unknown request, a parameter that is missing or of
///         another size, or a value that the setting does not have
OStatus controlCamera(OPrimitiveRequest request, const void* param, size_t param_size, CameraSettings* settings);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_CAMERA_SETTINGS_H
