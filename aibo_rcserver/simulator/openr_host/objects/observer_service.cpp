#include "simulator/openr_host/objects/observer_service.h"

#include <algorithm>

#include "simulator/openr_host/system.h"

namespace openr_host {

ObserverService::~ObserverService() {
  system_.forget(*this);
}

void ObserverService::announceReady(bool ready) {
  for (const auto& subject : subjects_) {
    system_.postReady(id_, subject, ready);
  }
}

void ObserverService::announceReady(const SubjectID& subject, bool ready) {
  if (std::find(subjects_.begin(), subjects_.end(), subject) != subjects_.end()) {
    system_.postReady(id_, subject, ready);
  }
}

}  // namespace openr_host
