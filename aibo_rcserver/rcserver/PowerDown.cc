#include "rcserver/PowerDown.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>

const longword PowerDown::LYING_DOWN_FRAMES;
const longword PowerDown::FILE_FRAMES;

const char* PowerDown::Observe(const OServiceEntry& entry) {
  OPowerStatus wanted;
  wanted.Set(orsbPAUSE | orsbBATTERY_CAPACITY_LOW | orsbBATTERY_CHARGING, 0, opsoREMAINING_CAPACITY_NOT_NOTIFY,
             opsoTEMPERATURE_NOT_NOTIFY, opsoTIME_DIF_NOT_NOTIFY, opsoVOLUME_NOT_NOTIFY);
  const OStatus status = OPENR::ObservePowerStatus(wanted, entry);
  entry_ = entry;
  if (status != oSUCCESS) {
    OSYSLOG1((osyslogERROR, "RCServer: neither the pause button nor a low battery switches the robot off (status %u)",
              static_cast<unsigned>(status)));
  }
  OPowerStatus now;
  if (OPENR::GetPowerStatus(&now) != oSUCCESS) {
    return NULL;
  }
  was_pressed_ = (now.robotStatus & orsbPAUSE) != 0;
  return Look(now);
}

// If the status is not observed, OPEN-R refuses, which does no harm.
void PowerDown::Unobserve() {
  OPENR::UnobservePowerStatus(entry_);
}

const char* PowerDown::Look(const OPowerStatus& status) {
  const bool is_pressed = (status.robotStatus & orsbPAUSE) != 0;
  const bool is_low =
      (status.robotStatus & (orsbBATTERY_CAPACITY_LOW | orsbBATTERY_CHARGING)) == orsbBATTERY_CAPACITY_LOW;
  const bool begins_to_be_pressed = is_pressed && !was_pressed_;
  const bool begins_to_be_low = is_low && !was_low_;
  was_pressed_ = is_pressed;
  was_low_ = is_low;
  const char* reason = NULL;
  if (begins_to_be_pressed && !IsOrdered() && body_->Joints().Walking().IsMoving()) {
    order_ = POWER_LIE_DOWN;
    reason = "the pause button was pressed: the robot lies down and shuts down";
  } else if (begins_to_be_pressed) {
    body_->CutMotors();
    order_ = POWER_SHUT_DOWN;
    reason = "the pause button was pressed: motors off, the robot shuts down";
  } else if (begins_to_be_low && !IsOrdered()) {
    order_ = POWER_LIE_DOWN;
    reason = "the battery is low: the robot lies down and shuts down";
  }
  if (reason != NULL) {
    OSYSPRINT(("RCServer: %s\n", reason));
  }
  return reason;
}

void PowerDown::Note(longword now) {
  if (!IsOrdered() || is_noted_) {
    return;
  }
  is_noted_ = true;
  noted_since_ = now;
  if (order_ != POWER_LIE_DOWN) {
    body_->CutMotors();
  }
}

// The motors go off when the robot has lain down. No client commands the robot any more, so it has lain down as soon as
// it stops moving.
void PowerDown::CarryOut(longword now) {
  if (!IsOrdered()) {
    return;
  }
  Note(now);
  if (order_ == POWER_LIE_DOWN && !was_told_to_lie_down_ && body_->Motors().AreOn()) {
    LieDown();
  }
  if (order_ == POWER_LIE_DOWN && body_->Joints().Walking().IsActive()) {
    if (now - noted_since_ < LYING_DOWN_FRAMES) {
      return;
    }
    OSYSLOG1((osyslogERROR, "RCServer: the robot does not lie down: it takes longer than 10 s"));
  }
  if (!MustWaitForFiles(now)) {
    SwitchOff();
  }
}

bool PowerDown::MustWaitForFiles(longword now) const {
  return files_.IsThere() && !files_.IsFree() && !IsOverdue(now);
}

void PowerDown::LieDown() {
  Walker& walker = body_->Joints().Walking();
  const char* const problem = walker.CanWalk() ? walker.Problem(protocol::version2::POSTURE_REST)
                                               : "this kind of robot has no known way to lie down";
  was_told_to_lie_down_ = true;
  if (problem == NULL) {
    body_->Joints().Take(protocol::version2::POSTURE_REST);
  } else {
    OSYSLOG1((osyslogERROR, "RCServer: the robot does not lie down: %s", problem));
  }
}

// The order stays in force until the robot is off, unless the robot refuses it.
void PowerDown::SwitchOff() {
  const bool reboots = order_ == POWER_REBOOT;
  if (!reboots) {
    order_ = POWER_SHUT_DOWN;  // the robot has lain down
  }
  if (!body_->SwitchOff(reboots)) {
    order_ = POWER_STAYS_ON;
    is_noted_ = false;
    was_told_to_lie_down_ = false;
  }
}
