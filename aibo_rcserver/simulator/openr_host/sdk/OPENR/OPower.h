/// @file OPower.h
#ifndef OPENR_OPOWER_H
#define OPENR_OPOWER_H

#include <OPENR/OPENR.h>
#include <time.h>

typedef bool OPower;
const OPower opowerON = true;
const OPower opowerOFF = false;

/// Bits of OPowerStatus::robotStatus (Level2 Reference Guide, page 76).
const longword orsbPAUSE = 0x00000001;  ///< the pause button was pressed
const longword orsbMOTOR_POWER = 0x00000002;
const longword orsbVIBRATION_DETECT = 0x00000004;
const longword orsbEX_PORT_CONNECTED = 0x00000008;  ///< to a station or a charger
const longword orsbSTATION_CONNECTED = 0x00000010;
const longword orsbEX_POWER_CONNECTED = 0x00000020;
const longword orsbBATTERY_CONNECTED = 0x00000040;
const longword orsbBATTERY_CHARGING = 0x00000080;
const longword orsbBATTERY_CAPACITY_FULL = 0x00000100;
const longword orsbBATTERY_CAPACITY_LOW = 0x00000200;
const longword orsbBATTERY_OVER_CURRENT = 0x00000400;
const longword orsbBATTERY_OVER_TEMP_DISCHARGING = 0x00000800;
const longword orsbBATTERY_OVER_TEMP_CHARGING = 0x00001000;
const longword orsbBATTERY_ERROR_OF_CHARGING = 0x00002000;
const longword orsbERROR_OF_PLUNGER = 0x00004000;  ///< the battery cannot be locked
const longword orsbOPEN_R_POWER_GOOD = 0x00008000;
const longword orsbERROR_OF_FAN = 0x00010000;
const longword orsbDATA_STREAM_FROM_STATION = 0x00020000;
const longword orsbREGISTER_UPDATED_BY_STATION = 0x00040000;
const longword orsbRTC_ERROR = 0x00080000;  ///< the clock's
const longword orsbRTC_OVERFLOW = 0x00100000;
const longword orsbRTC_RESET = 0x00200000;
const longword orsbRTC_SET = 0x00400000;
const longword orsbSPECIAL_MODE = 0x00800000;
const longword orsbBMN_DEBUG_MODE = 0x01000000;
const longword orsbCHARGER_STATUS = 0x02000000;
const longword orsbPLUNGER = 0x04000000;  ///< the battery is locked
const longword orsbSUSPENDED = 0x08000000;
const longword orsbSPECIAL_DATA_READ_REQ = 0x10000000;
const longword orsbALL = 0x1FFFFFFF;

/// Bits of OPowerStatus::batteryStatus (Level2 Reference Guide, page 78).
const word obsbERROR_CODE_MASK = 0x000F;
const word obsbFULLY_DISCHARGED = 0x0010;
const word obsbFULLY_CHARGED = 0x0020;
const word obsbDISCHARGING = 0x0040;
const word obsbINITIALIZED = 0x0080;  ///< always set
const word obsbREMAINING_TIME_ALARM = 0x0100;
const word obsbREMAINING_CAPACITY_ALARM = 0x0200;
const word obsbTERMINATED_DISCHARGING_ALARM = 0x0800;
const word obsbOVER_TEMP_ALARM = 0x1000;
const word obsbTERMINATED_CHARGING_ALARM = 0x4000;
const word obsbOVER_CHARGED_ALARM = 0x8000;
const word obsbALL = 0xFFFF;

/// Special values for OPENR::ObservePowerStatus(). For timeDif, the guide (page 79) gives 0xFE and the SDK's header
/// 0x7E. Objects are compiled with the header, so its value counts.
const word opsoREMAINING_CAPACITY_NOT_NOTIFY = 0xFFFE;
const word opsoTEMPERATURE_NOT_NOTIFY = 0xFFFE;
const sbyte opsoTIME_DIF_NOT_NOTIFY = 0x7E;
const byte opsoVOLUME_NOT_NOTIFY = 0xFE;

/// For OPENR::GetPowerStatus() and OPENR::ObservePowerStatus().
struct OPowerStatus {
  longword robotStatus;
  word batteryStatus;
  word remainingCapacity;     ///< per cent
  word temperature;           ///< the battery's, in tenths of a kelvin
  word fullyChargedCapacity;  ///< mAh
  word voltage;               ///< mV
  sword current;              ///< mA; negative while discharging
  sbyte timeDif;              ///< time zone
  byte volume;

  OPowerStatus()
      : robotStatus(0),
        batteryStatus(0),
        remainingCapacity(0),
        temperature(0),
        fullyChargedCapacity(0),
        voltage(0),
        current(0),
        timeDif(0),
        volume(0) {}

  /// For OPENR::ObservePowerStatus(), which ignores all other members.
  void Set(longword robot_bits, word battery_bits, word capacity, word kelvin, sbyte time_zone, byte loudness) {
    robotStatus = robot_bits;
    batteryStatus = battery_bits;
    remainingCapacity = capacity;
    temperature = kelvin;
    timeDif = time_zone;
    volume = loudness;
  }
};

/// Bits of OBootCondition::bitmap: events that boot the robot again.
const word obcbBOOT_TIMER = 0x0001;  ///< at OBootCondition::bootTime
const word obcbVIBRATION_DETECTED = 0x0002;
const word obcbPAUSE_SW = 0x0004;
const word obcbSTATION_CONNECTED = 0x0008;
const word obcbSTATION_DISCONNECTED = 0x0010;
const word obcbBATTERY_CAPACITY_FULL = 0x0020;

/// Kinds of OBootCondition::bootTime.
const longword obcbttRELATIVE = 0x00000000;  ///< seconds from now; 0 boots at once
const longword obcbttABSOLUTE = 0x80000000U;

/// For OPENR::Shutdown(): when to boot again.
struct OBootCondition {
  word bitmap;
  time_t bootTime;
  longword bootTimeType;
  byte vibrationLevel;

  // NOLINTNEXTLINE(google-explicit-constructor): as in the SDK
  OBootCondition(word bits) : bitmap(bits), bootTime(0), bootTimeType(obcbttRELATIVE), vibrationLevel(0) {}
  OBootCondition(word bits, time_t at, longword time_type)
      : bitmap(bits), bootTime(at), bootTimeType(time_type), vibrationLevel(0) {}
};

#endif  // OPENR_OPOWER_H
