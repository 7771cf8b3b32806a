#ifndef AIBO_RCSERVER_RCSERVER_BODY_POWER_SUPPLY_H
#define AIBO_RCSERVER_RCSERVER_BODY_POWER_SUPPLY_H

#include <OPENR/OPENR.h>
#include <OPENR/OPower.h>

/// Observes the pause button and the battery, as the SDK's POWERMON.BIN does. The button or a low battery switches the
/// robot off. If neither this class nor that program is used, the pause button does nothing and the battery runs down.
/// A battery that is being charged never counts as low.
class PowerSupply {
 public:
  enum Alarm { NO_ALARM, PAUSE_PRESSED, BATTERY_LOW };

  PowerSupply() : was_pressed_(false), was_low_(false), is_observing_(false) {}

  /// Asks OPEN-R to call an entry whenever the button or the battery changes (Level2 Reference Guide, page 79). If
  /// OPEN-R refuses, the console says so.
  void Observe(const OServiceEntry& entry);
  void Unobserve();

  /// Checks the current status. Call this once at the start, because OPEN-R reports only changes. A button that is
  /// already pressed is ignored until it is pressed again, because it may have booted the robot.
  Alarm LookNow();

  /// Checks a status.
  /// @return an alarm when it begins; if both begin at once, PAUSE_PRESSED
  Alarm Look(const OPowerStatus& status);

 private:
  bool was_pressed_;
  bool was_low_;
  bool is_observing_;
  OServiceEntry entry_;
};

#endif  // AIBO_RCSERVER_RCSERVER_BODY_POWER_SUPPLY_H
