#include "rcserver/PowerDown.h"

#include <OPENR/OSyslog.h>

const longword PowerDown::LYING_DOWN_FRAMES;
const longword PowerDown::FILE_FRAMES;

const char* PowerDown::Obey(PowerSupply::Alarm alarm) {
  const char* reason = NULL;
  if (alarm == PowerSupply::PAUSE_PRESSED && !IsOrdered() && body_->Joints().Walking().IsMoving()) {
    order_ = POWER_LIE_DOWN;
    reason = "the pause button was pressed: the robot lies down and shuts down";
  } else if (alarm == PowerSupply::PAUSE_PRESSED) {
    body_->CutMotors();
    order_ = POWER_SHUT_DOWN;
    reason = "the pause button was pressed: motors off, the robot shuts down";
  } else if (alarm == PowerSupply::BATTERY_LOW && !IsOrdered()) {
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

void PowerDown::CarryOut(longword now) {
  Note(now);
  if (order_ == POWER_LIE_DOWN && body_->Motors().AreOn()) {
    LieDown(now);
  } else if (IsOrdered() && !MustWaitForFiles(now)) {
    SwitchOff();
  }
}

// The motors go off when the robot has lain down. No client commands the robot any more, so it has lain down as soon as
// it stops moving.
void PowerDown::Continue(longword now) {
  if (!IsOrdered()) {
    return;
  }
  if (order_ == POWER_LIE_DOWN && body_->Joints().Walking().IsActive()) {
    if (now - lies_down_since_ < LYING_DOWN_FRAMES) {
      return;
    }
    OSYSLOG1((osyslogERROR, "RCServer: the robot does not lie down: it takes longer than 10 s"));
  } else if (MustWaitForFiles(now)) {
    return;
  }
  SwitchOff();
}

bool PowerDown::MustWaitForFiles(longword now) const {
  return files_.IsThere() && !files_.IsFree() && !IsOverdue(now);
}

void PowerDown::LieDown(longword now) {
  Walker& walker = body_->Joints().Walking();
  const char* const problem = walker.CanWalk() ? walker.Problem(protocol::version2::POSTURE_REST)
                                               : "this kind of robot has no known way to lie down";
  lies_down_since_ = now;
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
  }
}
