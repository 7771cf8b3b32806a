/// @file power_watch.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_POWER_WATCH_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_POWER_WATCH_H

#include <OPENR/OPENR.h>
#include <OPENR/OPower.h>

#include <vector>

namespace openr_host {

/// Observers of the power status: OPENR::ObservePowerStatus() (Level2 Reference Guide, page 79).
class PowerWatch {
 public:
  /// @param wanted bits to watch in robotStatus and batteryStatus. Other members are not watched, because nobody asks
  ///   for them
  /// @param present the status to compare the next one with
  void observe(const OServiceEntry& entry, const OPowerStatus& wanted, const OPowerStatus& present);

  /// @return false if the entry observes nothing
  bool unobserve(const OServiceEntry& entry);

  bool isWatching() const { return !watchers_.empty(); }

  /// @return the entries to notify of changes since the previous status
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
