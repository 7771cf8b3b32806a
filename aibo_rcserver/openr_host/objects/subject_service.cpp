#include "openr_host/objects/subject_service.h"

#include <algorithm>
#include <utility>

#include "openr_host/system.h"

namespace openr_host {

SubjectService::~SubjectService() {
  system_.forget(*this);
}

SubjectService::Connection* SubjectService::find(const ObserverID& observer) {
  const auto found = std::find_if(connections_.begin(), connections_.end(),
                                  [&](const Connection& connection) { return connection.observer == observer; });
  return found == connections_.end() ? nullptr : &*found;
}

void SubjectService::setReady(const ObserverID& observer, bool ready) {
  if (Connection* connection = find(observer)) {
    connection->ready = ready;
  }
}

bool SubjectService::isReady(const ObserverID& observer) const {
  return std::any_of(connections_.begin(), connections_.end(),
                     [&](const Connection& connection) { return connection.observer == observer && connection.ready; });
}

bool SubjectService::isAnyReady() const {
  return std::any_of(connections_.begin(), connections_.end(), [](const Connection& c) { return c.ready; });
}

bool SubjectService::isAllReady() const {
  return !connections_.empty() &&
         std::all_of(connections_.begin(), connections_.end(), [](const Connection& c) { return c.ready; });
}

void SubjectService::setData(RCRegion* region) {
  for (auto& connection : connections_) {
    connection.data.push_back(reference(region));
  }
}

void SubjectService::setData(const ObserverID& observer, RCRegion* region) {
  if (Connection* connection = find(observer)) {
    connection->data.push_back(reference(region));
  }
}

void SubjectService::clear() {
  for (auto& connection : connections_) {
    connection.data.clear();
  }
}

void SubjectService::notifyAll() {
  for (auto& connection : connections_) {
    notify(connection);
  }
}

void SubjectService::notify(const ObserverID& observer) {
  if (Connection* connection = find(observer)) {
    notify(*connection);
  }
}

void SubjectService::notify(Connection& connection) {
  const Regions data = std::exchange(connection.data, {});
  if (enabled_ && connection.ready && !data.empty()) {
    connection.ready = false;
    system_.postNotification(id_, connection.observer, data);
  }
}

}  // namespace openr_host
