#include "simulator/openr_host/objects/power_watch.h"

#include <algorithm>

namespace openr_host {
namespace {

bool isWorthTelling(const OPowerStatus& wanted, const OPowerStatus& before, const OPowerStatus& now) {
  return ((before.robotStatus ^ now.robotStatus) & wanted.robotStatus) != 0 ||
         ((before.batteryStatus ^ now.batteryStatus) & wanted.batteryStatus) != 0;
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
