/// @file OPrimitiveControl.h
/// Requests for OPENR::ControlPrimitive(), with the numbers of the OPEN-R SDK Level2 Reference Guide.
#ifndef OPENR_OPRIMITIVECONTROL_H
#define OPENR_OPRIMITIVECONTROL_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>

const OPrimitiveRequest oprmreqCAM_BASE = 384;
const OPrimitiveRequest oprmreqCAM_SET_WHITE_BALANCE = 384;
const OPrimitiveRequest oprmreqCAM_SET_GAIN = 385;
const OPrimitiveRequest oprmreqCAM_SET_SHUTTER_SPEED = 386;
const OPrimitiveRequest oprmreqCAM_AE_ON = 388;  ///< automatic exposure; this and the next three are only for the ERS-7
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

/// The speaker (Model Information ERS-7, 3.1.2). It begins with 8 kHz and 8 bits.
const OPrimitiveRequest oprmreqSPEAKER_MUTE_ON = 128;
const OPrimitiveRequest oprmreqSPEAKER_MUTE_OFF = 129;
const OPrimitiveRequest oprmreqSPEAKER_SET_VOLUME = 130;
const OPrimitiveRequest oprmreqSPEAKER_SET_SOUND_TYPE = 131;
const OPrimitiveRequest oprmreqSPEAKER_GET_SOUND_TYPE = 132;

typedef longword OSpeakerVolume;
const OSpeakerVolume ospkvolinfdB = 0x8000;
const OSpeakerVolume ospkvol25dB = 0xe700;
const OSpeakerVolume ospkvol18dB = 0xee00;
const OSpeakerVolume ospkvol10dB = 0xf600;  ///< the loudest

typedef longword OSpeakerSoundType;
const OSpeakerSoundType ospksndMONO8K8B = 0;
const OSpeakerSoundType ospksndMONO16K16B = 3;

struct OPrimitiveControl_SpeakerVolume {
  longword volume;
  explicit OPrimitiveControl_SpeakerVolume(longword vol) : volume(vol) {}
};

struct OPrimitiveControl_SpeakerSoundType {
  OSpeakerSoundType type;
  explicit OPrimitiveControl_SpeakerSoundType(OSpeakerSoundType sound) : type(sound) {}
};

/// The microphone. An ERS-7's takes none of these (Model Information ERS-7, 3.2.2).
const OPrimitiveRequest oprmreqMIC_UNI = 256;
const OPrimitiveRequest oprmreqMIC_OMNI = 257;
const OPrimitiveRequest oprmreqMIC_ALC_ON = 258;
const OPrimitiveRequest oprmreqMIC_ALC_OFF = 259;

#endif  // OPENR_OPRIMITIVECONTROL_H
