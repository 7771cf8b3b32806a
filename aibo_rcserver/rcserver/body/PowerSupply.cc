#include "rcserver/body/PowerSupply.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>

void PowerSupply::Observe(const OServiceEntry& entry) {
  OPowerStatus wanted;
  wanted.Set(orsbPAUSE | orsbBATTERY_CAPACITY_LOW | orsbBATTERY_CHARGING, 0, opsoREMAINING_CAPACITY_NOT_NOTIFY,
             opsoTEMPERATURE_NOT_NOTIFY, opsoTIME_DIF_NOT_NOTIFY, opsoVOLUME_NOT_NOTIFY);
  const OStatus status = OPENR::ObservePowerStatus(wanted, entry);
  is_observing_ = status == oSUCCESS;
  entry_ = entry;
  if (!is_observing_) {
    OSYSLOG1((osyslogERROR, "RCServer: neither the pause button nor a low battery switches the robot off (status %u)",
              static_cast<unsigned>(status)));
  }
}

void PowerSupply::Unobserve() {
  if (is_observing_) {
    OPENR::UnobservePowerStatus(entry_);
    is_observing_ = false;
  }
}

PowerSupply::Alarm PowerSupply::LookNow() {
  OPowerStatus status;
  if (OPENR::GetPowerStatus(&status) != oSUCCESS) {
    return NO_ALARM;
  }
  was_pressed_ = (status.robotStatus & orsbPAUSE) != 0;
  return Look(status);
}

PowerSupply::Alarm PowerSupply::Look(const OPowerStatus& status) {
  const bool is_pressed = (status.robotStatus & orsbPAUSE) != 0;
  const bool is_low =
      (status.robotStatus & (orsbBATTERY_CAPACITY_LOW | orsbBATTERY_CHARGING)) == orsbBATTERY_CAPACITY_LOW;
  const bool begins_to_be_pressed = is_pressed && !was_pressed_;
  const bool begins_to_be_low = is_low && !was_low_;
  was_pressed_ = is_pressed;
  was_low_ = is_low;
  if (begins_to_be_pressed) {
    return PAUSE_PRESSED;
  }
  return begins_to_be_low ? BATTERY_LOW : NO_ALARM;
}
