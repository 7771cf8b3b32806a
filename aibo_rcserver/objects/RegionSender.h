/// @file RegionSender.h
/// Sends a job or its result to another object, and keeps one that has come.
#ifndef AIBO_RCSERVER_OBJECTS_REGION_SENDER_H
#define AIBO_RCSERVER_OBJECTS_REGION_SENDER_H

#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include <OPENR/RCRegion.h>

/// Sends a Content, a plain struct without pointers, to one other object through a gate, in shared memory. The Content
/// belongs to the receiver until the receiver is ready for the next one. Nothing is queued.
///
/// @tparam REGIONS the number of memory regions, which take turns. With 1, the next Content can be written when the
///   receiver is ready for it; with 2, it can be written while the receiver still works on the last one
template <typename Content, int REGIONS = 1>
class RegionSender {
 public:
  RegionSender() : subject_(NULL), next_(0), has_sent_(false), last_ticket_(0) {
    for (int i = 0; i < REGIONS; ++i) {
      regions_[i] = NULL;
    }
  }

  /// Call this in DoInit, after NEW_ALL_SUBJECT_AND_OBSERVER.
  /// @param subject a gate with one observer
  /// @return false if the memory cannot be allocated
  bool Create(OSubject* subject) {
    subject_ = subject;
    bool succeeds = true;
    for (int i = 0; i < REGIONS; ++i) {
      regions_[i] = new RCRegion(sizeof(Content));
      succeeds = succeeds && regions_[i]->Base() != NULL;
    }
    return succeeds;
  }

  void Destroy() {
    for (int i = 0; i < REGIONS; ++i) {
      if (regions_[i] != NULL) {
        regions_[i]->RemoveReference();
        regions_[i] = NULL;
      }
    }
  }

  /// False if the receiver was never ready, because OBJECT.CFG or CONNECT.CFG does not name it.
  bool HasReceiver() const { return has_sent_ || subject_->IsReady(); }

  /// True if Send() may be called.
  bool IsFree() const { return subject_->IsReady() && Memory() != NULL; }

  /// The place for the next Content. It stays the same until Send(), even if the receiver returns another region.
  /// @return NULL if the receiver still has the region
  Content* Memory() const {
    RCRegion* const region = regions_[next_];
    return region->NumberOfReference() > 1 ? NULL : static_cast<Content*>(static_cast<void*>(region->Base()));
  }

  /// A new number for a job, not 0, which the job's result repeats.
  unsigned NewTicket() {
    ++last_ticket_;
    last_ticket_ += last_ticket_ == 0 ? 1 : 0;
    return last_ticket_;
  }

  /// Sends the Content. Call this only if IsFree().
  void Send() {
    subject_->SetData(regions_[next_]);
    subject_->NotifyObservers();
    next_ = (next_ + 1) % REGIONS;
    has_sent_ = true;
  }

 private:
  RegionSender(const RegionSender&);
  RegionSender& operator=(const RegionSender&);

  OSubject* subject_;
  RCRegion* regions_[REGIONS];
  int next_;
  bool has_sent_;
  unsigned last_ticket_;
};

/// A Content that has come from another object, kept as long as it is needed. The sender sends no other until then.
template <typename Content>
class HeldRegion {
 public:
  HeldRegion() : region_(NULL), observer_(NULL) {}

  /// @param observer the observer through which the Content has come
  void Hold(const ONotifyEvent& event, OObserver* observer) {
    region_ = event.RCData(0);
    region_->AddReference();
    observer_ = observer;
  }

  bool IsThere() const { return region_ != NULL; }
  const Content& Get() const { return *static_cast<const Content*>(static_cast<const void*>(region_->Base())); }

  /// Gives the Content back, if there is one, so that the next one can come.
  void Release() {
    if (Destroy()) {
      observer_->AssertReady();
    }
  }

  /// Does the same in DoDestroy, when no Content may come any more.
  /// @return true if there was a Content
  bool Destroy() {
    const bool was_there = IsThere();
    if (was_there) {
      region_->RemoveReference();
      region_ = NULL;
    }
    return was_there;
  }

 private:
  HeldRegion(const HeldRegion&);
  HeldRegion& operator=(const HeldRegion&);

  RCRegion* region_;
  OObserver* observer_;
};

#endif  // AIBO_RCSERVER_OBJECTS_REGION_SENDER_H
