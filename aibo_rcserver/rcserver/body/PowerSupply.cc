#include "rcserver/body/PowerSupply.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>

void PowerSupply::Observe(const OServiceEntry& entry) {
  OPowerStatus wanted;
  wanted.Set(orsbPAUSE | orsbBATTERY_CAPACITY_LOW, 0, opsoREMAINING_CAPACITY_NOT_NOTIFY, opsoTEMPERATURE_NOT_NOTIFY,
             opsoTIME_DIF_NOT_NOTIFY, opsoVOLUME_NOT_NOTIFY);
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
  // A robot that is put on its station with an empty battery may stay on.
  if (OPENR::GetPowerStatus(&status) != oSUCCESS || (status.robotStatus & orsbBATTERY_CHARGING) != 0) {
    return NO_ALARM;
  }
  return Look(status);
}

PowerSupply::Alarm PowerSupply::Look(const OPowerStatus& status) {
  Alarm alarm = NO_ALARM;
  if ((status.robotStatus & orsbPAUSE) != 0) {
    alarm = PAUSE_PRESSED;
  } else if ((status.robotStatus & orsbBATTERY_CAPACITY_LOW) != 0 && last_ != PAUSE_PRESSED) {
    alarm = BATTERY_LOW;
  }
  if (alarm == last_ || alarm == NO_ALARM) {
    return NO_ALARM;
  }
  last_ = alarm;
  return alarm;
}
