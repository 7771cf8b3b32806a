/// @file subject_service.h
#ifndef OPENR_HOST_OBJECTS_SUBJECT_SERVICE_H
#define OPENR_HOST_OBJECTS_SUBJECT_SERVICE_H

#include <OPENR/ObjcommEvent.h>

#include <vector>

#include "openr_host/objects/regions.h"

namespace openr_host {

class System;

/// What an OSubject is inside: its observers, which of them are ready, and what was set for them.
class SubjectService {
 public:
  SubjectService(System& system, const SubjectID& id) : system_(system), id_(id) {}
  ~SubjectService();
  SubjectService(const SubjectService&) = delete;
  SubjectService& operator=(const SubjectService&) = delete;

  const SubjectID& id() const { return id_; }
  void enable(bool enabled) { enabled_ = enabled; }

  void connect(const ObserverID& observer) { connections_.push_back({observer, false, {}}); }
  void setReady(const ObserverID& observer, bool ready);

  bool isReady(const ObserverID& observer) const;
  bool isAnyReady() const;
  bool isAllReady() const;

  void setData(RCRegion* region);
  void setData(const ObserverID& observer, RCRegion* region);
  void clear();
  void notifyAll();
  void notify(const ObserverID& observer);

 private:
  struct Connection {
    ObserverID observer;
    bool ready;
    Regions data;  ///< set and not yet sent
  };

  Connection* find(const ObserverID& observer);
  void notify(Connection& connection);

  System& system_;
  const SubjectID id_;
  bool enabled_ = false;
  std::vector<Connection> connections_;
};

}  // namespace openr_host

#endif  // OPENR_HOST_OBJECTS_SUBJECT_SERVICE_H
