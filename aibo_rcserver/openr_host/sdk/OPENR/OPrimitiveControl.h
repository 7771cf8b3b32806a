/// @file OPrimitiveControl.h
/// What OPENR::ControlPrimitive() can ask of the camera. Numbers: OPEN-R SDK Level2 Reference Guide.
#ifndef OPENR_OPRIMITIVECONTROL_H
#define OPENR_OPRIMITIVECONTROL_H

#include <OPENR/OPENR.h>

typedef longword OPrimitiveRequest;

const OPrimitiveRequest oprmreqCAM_BASE = 384;
const OPrimitiveRequest oprmreqCAM_SET_WHITE_BALANCE = 384;
const OPrimitiveRequest oprmreqCAM_SET_GAIN = 385;
const OPrimitiveRequest oprmreqCAM_SET_SHUTTER_SPEED = 386;
const OPrimitiveRequest oprmreqCAM_AE_ON = 388;  ///< automatic exposure; ERS-7 only, as are the next three
const OPrimitiveRequest oprmreqCAM_AE_OFF = 389;
const OPrimitiveRequest oprmreqCAM_AWB_ON = 390;  ///< automatic white balance
const OPrimitiveRequest oprmreqCAM_AWB_OFF = 391;

const longword ocamparamWB_INDOOR_MODE = 1;   ///< 2856 K
const longword ocamparamWB_OUTDOOR_MODE = 2;  ///< 6500 K
const longword ocamparamWB_FL_MODE = 3;       ///< fluorescent lamps, 5000 K; the default

const longword ocamparamGAIN_LOW = 1;   ///< -6 dB
const longword ocamparamGAIN_MID = 2;   ///< 0 dB
const longword ocamparamGAIN_HIGH = 3;  ///< +6 dB

const longword ocamparamSHUTTER_SLOW = 1;  ///< 1/50 s
const longword ocamparamSHUTTER_MID = 2;   ///< 1/100 s; the default
const longword ocamparamSHUTTER_FAST = 3;  ///< 1/200 s

/// The argument of the three SET requests.
struct OPrimitiveControl_CameraParam {
  longword camparam;
  explicit OPrimitiveControl_CameraParam(longword param) : camparam(param) {}
};

#endif  // OPENR_OPRIMITIVECONTROL_H
