/// @file PowerSupply.h
/// The pause button and the battery.
#ifndef AIBO_RCSERVER_RCSERVER_BODY_POWER_SUPPLY_H
#define AIBO_RCSERVER_RCSERVER_BODY_POWER_SUPPLY_H

#include <OPENR/OPENR.h>
#include <OPENR/OPower.h>

/// Observes what has to switch the robot off, as POWERMON.BIN of the SDK does: without one of the two, nobody obeys the
/// pause button, and nobody spares an empty battery. A battery that is being charged is not low.
class PowerSupply {
 public:
  enum Alarm { NO_ALARM, PAUSE_PRESSED, BATTERY_LOW };

  PowerSupply() : was_pressed_(false), was_low_(false), is_observing_(false) {}

  /// Asks OPEN-R to call an entry at every change of what Look() looks at (Level2 Reference Guide, page 79). If it
  /// refuses, the log says so.
  void Observe(const OServiceEntry& entry);
  void Unobserve();

  /// Looks at the present status. To be called once at first, because OPEN-R calls at changes only. A button that is
  /// pressed already counts only when it is pressed again: it may be what has booted the robot.
  Alarm LookNow();

  /// @return an alarm when it begins; of two, the button
  Alarm Look(const OPowerStatus& status);

 private:
  PowerSupply(const PowerSupply&);
  PowerSupply& operator=(const PowerSupply&);

  bool was_pressed_;
  bool was_low_;
  bool is_observing_;
  OServiceEntry entry_;
};

#endif  // AIBO_RCSERVER_RCSERVER_BODY_POWER_SUPPLY_H
