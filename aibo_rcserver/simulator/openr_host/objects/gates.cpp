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

void SubjectService::connect(const ObserverID& observer, const BufferControl& control) {
  connections_.emplace_back();
  connections_.back().observer = observer;
  connections_.back().control = control;
}

const SubjectService::Connection* SubjectService::find(const ObserverID& observer) const {
  const auto found = std::find_if(connections_.begin(), connections_.end(),
                                  [&](const Connection& connection) { return connection.observer == observer; });
  return found == connections_.end() ? nullptr : &*found;
}

SubjectService::Connection* SubjectService::find(const ObserverID& observer) {
  return const_cast<Connection*>(std::as_const(*this).find(observer));
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

Readiness SubjectService::readiness(const ObserverID& observer) const {
  const Connection* connection = find(observer);
  return connection == nullptr ? Readiness::kUnknown : connection->readiness;
}

bool SubjectService::isAnyReady() const {
  return std::any_of(connections_.begin(), connections_.end(),
                     [](const Connection& c) { return c.readiness == Readiness::kAssertReady; });
}

bool SubjectService::isAllReady() const {
  return isAnyReady() && std::none_of(connections_.begin(), connections_.end(),
                                      [](const Connection& c) { return c.readiness == Readiness::kUnknown; });
}

bool SubjectService::isWanted() const {
  return std::any_of(connections_.begin(), connections_.end(),
                     [](const Connection& c) { return c.readiness != Readiness::kDeassertReady; });
}

std::size_t SubjectService::capacity(const Connection& connection) const {
  return std::max(buffer_size_, connection.control.max);
}

std::size_t SubjectService::roomFor(const ObserverID& observer) const {
  const Connection* connection = find(observer);
  return connection == nullptr ? 0 : capacity(*connection) - connection->kept.size();
}

void SubjectService::setData(RCRegion* region) {
  for (auto& connection : connections_) {
    connection.set.push_back(reference(region));
  }
}

void SubjectService::setData(const ObserverID& observer, RCRegion* region) {
  if (Connection* connection = find(observer)) {
    connection->set.push_back(reference(region));
  }
}

void SubjectService::clear() {
  for (auto& connection : connections_) {
    connection.set.clear();
    connection.kept.clear();
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
  Regions data = std::exchange(connection.set, {});
  if (!enabled_ || data.empty() || connection.readiness == Readiness::kDeassertReady) {
    return;
  }
  if (connection.skipped < connection.control.skip) {
    ++connection.skipped;
    return;
  }
  connection.skipped = 0;
  connection.kept.push_back(std::move(data));
  if (connection.kept.size() > capacity(connection)) {
    connection.kept.pop_front();
  }
  sendKept(connection);
}

void SubjectService::sendKept(Connection& connection) {
  if (connection.readiness != Readiness::kAssertReady || connection.kept.empty() ||
      connection.kept.size() < connection.control.min) {
    return;
  }
  Regions data = std::move(connection.kept.front());
  for (auto kept = connection.kept.begin() + 1; kept != connection.kept.end(); ++kept) {
    data.insert(data.end(), kept->begin(), kept->end());
  }
  connection.kept.clear();
  connection.readiness = Readiness::kUnknown;
  system_.postNotification(id_, connection.observer, std::move(data));
}

}  // namespace openr_host
