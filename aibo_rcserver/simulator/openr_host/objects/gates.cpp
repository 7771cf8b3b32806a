#include "simulator/openr_host/objects/gates.h"

#include <algorithm>
#include <utility>

#include "simulator/openr_host/objects/system.h"

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

SubjectService::~SubjectService() {
  system_.forget(*this);
}

void SubjectService::connect(const ObserverID& observer) {
  connections_.push_back({observer});
}

SubjectService::Connection* SubjectService::find(const ObserverID& observer) {
  const auto found = std::find_if(connections_.begin(), connections_.end(),
                                  [&](const Connection& connection) { return connection.observer == observer; });
  return found == connections_.end() ? nullptr : &*found;
}

void SubjectService::assertReady(const ObserverID& observer) {
  if (Connection* connection = find(observer)) {
    connection->readiness = Readiness::kAssertReady;
    sendKept(*connection);
  }
}

void SubjectService::deassertReady(const ObserverID& observer) {
  if (Connection* connection = find(observer)) {
    connection->readiness = Readiness::kDeassertReady;
    connection->kept.clear();
  }
}

bool SubjectService::isAnyReady() const {
  return std::any_of(connections_.begin(), connections_.end(),
                     [](const Connection& c) { return c.readiness == Readiness::kAssertReady; });
}

bool SubjectService::isWanted() const {
  return std::any_of(connections_.begin(), connections_.end(),
                     [](const Connection& c) { return c.readiness != Readiness::kDeassertReady; });
}

void SubjectService::clear() {
  for (auto& connection : connections_) {
    connection.set.clear();
    connection.kept.clear();
  }
}

void SubjectService::setData(RCRegion* region) {
  for (auto& connection : connections_) {
    connection.set.push_back(reference(region));
  }
}

void SubjectService::notifyAll() {
  for (auto& connection : connections_) {
    notify(connection);
  }
}

void SubjectService::notify(Connection& connection) {
  Regions data = std::exchange(connection.set, {});
  if (data.empty() || connection.readiness == Readiness::kDeassertReady) {
    return;
  }
  connection.kept = std::move(data);
  sendKept(connection);
}

void SubjectService::sendKept(Connection& connection) {
  if (connection.readiness == Readiness::kAssertReady && !connection.kept.empty()) {
    connection.readiness = Readiness::kUnknown;
    system_.postNotification(id_, connection.observer, std::exchange(connection.kept, {}));
  }
}

}  // namespace openr_host
