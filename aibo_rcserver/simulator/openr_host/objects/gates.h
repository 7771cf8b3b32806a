/// @file gates.h
/// The inside of the SDK's OSubject and OObserver.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_GATES_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_GATES_H

#include <OPENR/ObjcommEvent.h>
#include <OPENR/RCRegion.h>

#include <cstddef>
#include <deque>
#include <memory>
#include <vector>

namespace openr_host {

class System;

/// Holds a reference to a region, which goes when the last copy of this goes.
using RegionReference = std::shared_ptr<RCRegion>;

/// Data on its way.
using Regions = std::vector<RegionReference>;

inline RegionReference reference(RCRegion* region) {
  region->AddReference();
  return {region, [](RCRegion* referenced) { referenced->RemoveReference(); }};
}

/// How a subject treats one observer's notifications: OObserver::SetBufCtrlParam() (Level2 Reference Guide, page 27).
struct BufferControl {
  std::size_t skip = 0;  ///< notifications left out after each one
  std::size_t min = 1;   ///< notifications that are sent together
  std::size_t max = 1;   ///< notifications kept while the observer is not ready; the oldest is lost first
};

/// The inside of an OObserver: its subjects.
class ObserverService {
 public:
  ObserverService(System& system, const ObserverID& id) : system_(system), id_(id) {}
  ~ObserverService();
  ObserverService(const ObserverService&) = delete;
  ObserverService& operator=(const ObserverService&) = delete;

  const ObserverID& id() const { return id_; }

  /// Counts for connections that are made later.
  void setBufferControl(const BufferControl& control) { control_ = control; }
  const BufferControl& bufferControl() const { return control_; }

  void connect(const SubjectID& subject) { subjects_.push_back(subject); }
  int numberOfSubjects() const { return static_cast<int>(subjects_.size()); }

  void announceReady(bool ready);
  void announceReady(const SubjectID& subject, bool ready);

 private:
  System& system_;
  const ObserverID id_;
  BufferControl control_;
  std::vector<SubjectID> subjects_;
};

/// What an observer has last said to a subject. An observer that was sent something has said nothing since.
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
  void enable(bool enabled) { enabled_ = enabled; }

  /// @param size notifications kept for an observer that has said nothing, unless it asks for more itself; not 0
  void setBufferSize(std::size_t size) { buffer_size_ = size; }
  std::size_t bufferSize() const { return buffer_size_; }

  /// @param control what the observer has asked for in its DoInit()
  void connect(const ObserverID& observer, const BufferControl& control);

  /// The observer is ready: data that was kept for it is sent.
  void assertReady(const ObserverID& observer);

  /// The observer wants nothing: data that was kept for it is deleted.
  void deassertReady(const ObserverID& observer);

  /// kUnknown, too, if there is no such observer.
  Readiness readiness(const ObserverID& observer) const;
  bool isAnyReady() const;

  /// At least one is ready, and every other one is ready or wants nothing.
  bool isAllReady() const;

  /// At least one might get what is sent now, at once or when it is ready.
  bool isWanted() const;

  /// How many more notifications the buffer of this observer holds before the oldest one is lost.
  std::size_t roomFor(const ObserverID& observer) const;

  void setData(RCRegion* region);
  void setData(const ObserverID& observer, RCRegion* region);
  void clear();
  void notifyAll();
  void notify(const ObserverID& observer);

 private:
  struct Connection {
    ObserverID observer;
    BufferControl control;
    Readiness readiness = Readiness::kUnknown;
    std::size_t skipped = 0;   ///< notifications since one was last kept or sent
    Regions set;               ///< since the last notification
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
