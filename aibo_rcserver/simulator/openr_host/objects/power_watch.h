/// @file power_watch.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_POWER_WATCH_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_POWER_WATCH_H

#include <OPENR/OPENR.h>
#include <OPENR/OPower.h>

#include <vector>

namespace openr_host {

/// Who observes the power status, and what of it: OPENR::ObservePowerStatus() (Level2 Reference Guide, page 79).
class PowerWatch {
 public:
  /// @param wanted bits that are looked at in robotStatus and batteryStatus; the other members are a value, or one of
  /// the opso constants of OPower.h
  /// @param present status from which changes count
  void observe(const OServiceEntry& entry, const OPowerStatus& wanted, const OPowerStatus& present);

  /// @return false if the entry observes nothing
  bool unobserve(const OServiceEntry& entry);

  bool isWatching() const { return !watchers_.empty(); }

  /// @return the entries that are to be told
  std::vector<OServiceEntry> look(const OPowerStatus& status);

 private:
  struct Watcher {
    OServiceEntry entry;
    OPowerStatus wanted;
    OPowerStatus seen;
  };

  std::vector<Watcher> watchers_;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_POWER_WATCH_H
