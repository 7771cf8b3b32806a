/// @file gates.h
/// The inside of the SDK's OSubject and OObserver.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_GATES_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_GATES_H

#include <OPENR/ObjcommEvent.h>
#include <OPENR/RCRegion.h>

#include <boost/smart_ptr/intrusive_ptr.hpp>
#include <vector>

/// The two functions that boost::intrusive_ptr needs.
inline void intrusive_ptr_add_ref(RCRegion* region) {
  region->AddReference();
}
inline void intrusive_ptr_release(RCRegion* region) {
  region->RemoveReference();
}

namespace openr_host {

class System;

using RegionReference = boost::intrusive_ptr<RCRegion>;

/// The data of a notification.
using Regions = std::vector<RegionReference>;

inline RegionReference reference(RCRegion* region) {
  return RegionReference(region);
}

/// The inside of an OObserver: its subjects.
class ObserverService {
 public:
  ObserverService(System& system, const ObserverID& id) : system_(system), id_(id) {}
  ~ObserverService();
  ObserverService(const ObserverService&) = delete;
  ObserverService& operator=(const ObserverService&) = delete;

  const ObserverID& id() const { return id_; }

  void connect(const SubjectID& subject) { subjects_.push_back(subject); }

  /// Tells all subjects, or one of them, whether the observer is ready. A subject that is not connected is ignored.
  void announceReady(bool ready);
  void announceReady(const SubjectID& subject, bool ready);

 private:
  System& system_;
  const ObserverID id_;
  std::vector<SubjectID> subjects_;
};

/// What an observer has told a subject since its last data.
enum class Readiness { kUnknown, kAssertReady, kDeassertReady };

/// The inside of an OSubject: its observers, their readiness, and their waiting data (Level2 Reference Guide, pages 13
/// to 23).
class SubjectService {
 public:
  SubjectService(System& system, const SubjectID& id) : system_(system), id_(id) {}
  ~SubjectService();
  SubjectService(const SubjectService&) = delete;
  SubjectService& operator=(const SubjectService&) = delete;

  const SubjectID& id() const { return id_; }

  void connect(const ObserverID& observer);

  /// Sends the observer the data that was kept for it.
  void assertReady(const ObserverID& observer);

  /// Deletes the data that was kept for the observer.
  void deassertReady(const ObserverID& observer);

  /// True if CONNECT.CFG names an observer.
  bool isObserved() const { return !connections_.empty(); }

  bool isAnyReady() const;

  /// True if an observer could receive data sent now, at once or later.
  bool isWanted() const;

  /// Deletes the data that waits for observers or for the next notification.
  void clear();

  /// Adds data to the next notification.
  void setData(RCRegion* region);

  /// Sends the data to all observers, or keeps it until they are ready or newer data comes.
  void notifyAll();

 private:
  struct Connection {
    ObserverID observer;
    Readiness readiness = Readiness::kUnknown;
    Regions set{};   ///< data set since the last notification
    Regions kept{};  ///< the newest notification, kept until the observer is ready
  };

  Connection* find(const ObserverID& observer);
  void notify(Connection& connection);
  void sendKept(Connection& connection);

  System& system_;
  const SubjectID id_;
  std::vector<Connection> connections_;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_GATES_H
