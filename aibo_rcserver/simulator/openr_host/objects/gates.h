/// @file gates.h
/// The inside of the SDK's OSubject and OObserver.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_GATES_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_GATES_H

#include <OPENR/ObjcommEvent.h>
#include <OPENR/RCRegion.h>

#include <boost/smart_ptr/intrusive_ptr.hpp>
#include <cstddef>
#include <deque>
#include <vector>

/// @name For boost::intrusive_ptr
/// @{
inline void intrusive_ptr_add_ref(RCRegion* region) {
  region->AddReference();
}
inline void intrusive_ptr_release(RCRegion* region) {
  region->RemoveReference();
}
/// @}

namespace openr_host {

class System;

/// A reference to a region; each copy is one more.
using RegionReference = boost::intrusive_ptr<RCRegion>;

/// The data of a notification.
using Regions = std::vector<RegionReference>;

/// Adds a reference to the region.
inline RegionReference reference(RCRegion* region) {
  return RegionReference(region);
}

/// How a subject treats an observer's notifications: OObserver::SetBufCtrlParam() (Level2 Reference Guide, page 27).
struct BufferControl {
  std::size_t skip = 0;  ///< notifications left out after each one
  std::size_t min = 1;   ///< notifications to send together
  std::size_t max = 1;   ///< notifications to keep while the observer is not ready; the oldest is lost first
};

/// The inside of an OObserver: its subjects.
class ObserverService {
 public:
  ObserverService(System& system, const ObserverID& id) : system_(system), id_(id) {}
  ~ObserverService();
  ObserverService(const ObserverService&) = delete;
  ObserverService& operator=(const ObserverService&) = delete;

  const ObserverID& id() const { return id_; }

  /// Applies to connections that are made later.
  void setBufferControl(const BufferControl& control) { control_ = control; }
  const BufferControl& bufferControl() const { return control_; }

  /// Adds a connected subject.
  void connect(const SubjectID& subject) { subjects_.push_back(subject); }
  int numberOfSubjects() const { return static_cast<int>(subjects_.size()); }

  /// Tells all subjects, or one of them, whether the observer is ready. Does nothing if the subject is not connected.
  void announceReady(bool ready);
  void announceReady(const SubjectID& subject, bool ready);

 private:
  System& system_;
  const ObserverID id_;
  BufferControl control_;
  std::vector<SubjectID> subjects_;
};

/// What an observer has told a subject since it was last sent data.
enum class Readiness { kUnknown, kAssertReady, kDeassertReady };

/// The inside of an OSubject: its observers, their readiness, and the data that waits for them
/// (Level2 Reference Guide, pages 13 to 23).
class SubjectService {
 public:
  SubjectService(System& system, const SubjectID& id) : system_(system), id_(id) {}
  ~SubjectService();
  SubjectService(const SubjectService&) = delete;
  SubjectService& operator=(const SubjectService&) = delete;

  const SubjectID& id() const { return id_; }

  /// While it is not enabled, the subject sends nothing. It is off at first.
  void enable(bool enabled) { enabled_ = enabled; }

  /// @param size notifications to keep for an observer that is not ready, unless it asks for more; not 0
  void setBufferSize(std::size_t size) { buffer_size_ = size; }
  std::size_t bufferSize() const { return buffer_size_; }

  /// Adds a connected observer.
  /// @param control the observer's settings from its DoInit()
  void connect(const ObserverID& observer, const BufferControl& control);

  /// The observer is ready: sends the data that was kept for it.
  void assertReady(const ObserverID& observer);

  /// The observer wants no data: deletes the data that was kept for it.
  void deassertReady(const ObserverID& observer);

  /// Also kUnknown if there is no such observer.
  Readiness readiness(const ObserverID& observer) const;
  bool isAnyReady() const;

  /// True if at least one observer is ready, and every other one is ready or wants no data.
  bool isAllReady() const;

  /// True if at least one observer might receive data that is sent now, at once or later.
  bool isWanted() const;

  /// The number of notifications that can still be kept for this observer before the oldest one is lost.
  std::size_t roomFor(const ObserverID& observer) const;

  /// Adds data to the next notification of all observers, or of one.
  void setData(RCRegion* region);
  void setData(const ObserverID& observer, RCRegion* region);

  /// Drops all data that has not been sent.
  void clear();

  /// Sends the data that was set to all observers, or to one, or keeps it until they are ready.
  void notifyAll();
  void notify(const ObserverID& observer);

 private:
  struct Connection {
    ObserverID observer;
    BufferControl control;
    Readiness readiness = Readiness::kUnknown;
    std::size_t skipped = 0;   ///< notifications left out since the last one that was kept or sent
    Regions set;               ///< data set since the last notification
    std::deque<Regions> kept;  ///< notifications that wait until the observer is ready
  };

  Connection* find(const ObserverID& observer);
  const Connection* find(const ObserverID& observer) const;
  std::size_t capacity(const Connection& connection) const;
  void notify(Connection& connection);
  void sendKept(Connection& connection);

  System& system_;
  const SubjectID id_;
  bool enabled_ = false;
  std::size_t buffer_size_ = 1;
  std::vector<Connection> connections_;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_GATES_H
