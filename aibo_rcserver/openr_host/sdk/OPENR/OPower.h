/// @file OPower.h
/// Motor power, battery, shutting down and booting anew.
#ifndef OPENR_OPOWER_H
#define OPENR_OPOWER_H

#include <OPENR/OPENR.h>
#include <time.h>

enum OPower { opowerOFF, opowerON };

/// @name Bits of OPowerStatus::robotStatus
/// @{
const longword orsbPAUSE = 0x00000001;  ///< the pause switch has been pressed
const longword orsbMOTOR_POWER = 0x00000002;
const longword orsbVIBRATION_DETECT = 0x00000004;
const longword orsbSTATION_CONNECTED = 0x00000010;
const longword orsbBATTERY_CONNECTED = 0x00000040;
const longword orsbBATTERY_CHARGING = 0x00000080;
const longword orsbBATTERY_CAPACITY_FULL = 0x00000100;
const longword orsbBATTERY_CAPACITY_LOW = 0x00000200;
/// @}

/// @name Bits of OPowerStatus::batteryStatus
/// @{
const word obsbFULLY_DISCHARGED = 0x0010;
const word obsbFULLY_CHARGED = 0x0020;
const word obsbDISCHARGING = 0x0040;
const word obsbREMAINING_CAPACITY_ALARM = 0x0200;
const word obsbOVER_TEMP_ALARM = 0x1000;
/// @}

/// What OPENR::GetPowerStatus() tells.
struct OPowerStatus {
  longword robotStatus;
  word batteryStatus;
  word remainingCapacity;     ///< per cent
  word temperature;           ///< of the battery, in tenths of a kelvin
  word fullyChargedCapacity;  ///< mAh
  word voltage;               ///< mV
  sword current;              ///< mA; below 0 while it is discharged
  sbyte timeDif;              ///< of the robot's time zone
  byte volume;                ///< of the speaker

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
};

/// @name Bits of OBootCondition::bitmap: what boots the robot again
/// @{
const word obcbBOOT_TIMER = 0x0001;  ///< OBootCondition::bootTime has come
const word obcbVIBRATION_DETECTED = 0x0002;
const word obcbPAUSE_SW = 0x0004;
const word obcbSTATION_CONNECTED = 0x0008;
const word obcbSTATION_DISCONNECTED = 0x0010;
const word obcbBATTERY_CAPACITY_FULL = 0x0020;
/// @}

/// @name Kinds of OBootCondition::bootTime
/// @{
const longword obcbttRELATIVE = 0x00000000;  ///< seconds from now; 0 boots at once
const longword obcbttABSOLUTE = 0x80000000U;
/// @}

/// What OPENR::Shutdown() is told: when to boot again.
struct OBootCondition {
  word bitmap;
  time_t bootTime;
  longword bootTimeType;
  byte vibrationLevel;

  explicit OBootCondition(word bits) : bitmap(bits), bootTime(0), bootTimeType(obcbttRELATIVE), vibrationLevel(0) {}
  OBootCondition(word bits, time_t at, longword time_type)
      : bitmap(bits), bootTime(at), bootTimeType(time_type), vibrationLevel(0) {}
};

#endif  // OPENR_OPOWER_H
