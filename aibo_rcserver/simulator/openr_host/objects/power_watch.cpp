#include "simulator/openr_host/objects/power_watch.h"

#include <algorithm>

namespace openr_host {
namespace {

/// @param every_change, never the value's two opso constants; any other `wanted` is the value to wait for
template <typename Value>
bool isWorthTelling(Value wanted, Value before, Value now, Value every_change, Value never) {
  return before != now && wanted != never && (wanted == every_change || wanted == now);
}

bool isWorthTelling(const OPowerStatus& wanted, const OPowerStatus& before, const OPowerStatus& now) {
  return ((before.robotStatus ^ now.robotStatus) & wanted.robotStatus) != 0 ||
         ((before.batteryStatus ^ now.batteryStatus) & wanted.batteryStatus) != 0 ||
         isWorthTelling(wanted.remainingCapacity, before.remainingCapacity, now.remainingCapacity,
                        opsoREMAINING_CAPACITY_NOTIFY_EVERY_CHANGE, opsoREMAINING_CAPACITY_NOT_NOTIFY) ||
         isWorthTelling(wanted.temperature, before.temperature, now.temperature, opsoTEMPERATURE_NOTIFY_EVERY_CHANGE,
                        opsoTEMPERATURE_NOT_NOTIFY) ||
         isWorthTelling(wanted.timeDif, before.timeDif, now.timeDif, opsoTIME_DIF_NOTIFY_EVERY_CHANGE,
                        opsoTIME_DIF_NOT_NOTIFY) ||
         isWorthTelling(wanted.volume, before.volume, now.volume, opsoVOLUME_NOTIFY_EVERY_CHANGE,
                        opsoVOLUME_NOT_NOTIFY);
}

}  // namespace

void PowerWatch::observe(const OServiceEntry& entry, const OPowerStatus& wanted, const OPowerStatus& present) {
  unobserve(entry);
  watchers_.push_back({entry, wanted, present});
}

bool PowerWatch::unobserve(const OServiceEntry& entry) {
  const auto end = std::remove_if(watchers_.begin(), watchers_.end(),
                                  [&](const Watcher& watcher) { return watcher.entry == entry; });
  const bool found = end != watchers_.end();
  watchers_.erase(end, watchers_.end());
  return found;
}

std::vector<OServiceEntry> PowerWatch::look(const OPowerStatus& status) {
  std::vector<OServiceEntry> told;
  for (auto& watcher : watchers_) {
    if (isWorthTelling(watcher.wanted, watcher.seen, status)) {
      told.push_back(watcher.entry);
    }
    watcher.seen = status;
  }
  return told;
}

}  // namespace openr_host
