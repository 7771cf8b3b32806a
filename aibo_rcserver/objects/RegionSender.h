/// @file RegionSender.h
/// Sends a job, or its result, from one of our objects to another.
#ifndef AIBO_RCSERVER_OBJECTS_REGION_SENDER_H
#define AIBO_RCSERVER_OBJECTS_REGION_SENDER_H

#include <OPENR/OSubject.h>
#include <OPENR/RCRegion.h>

/// Sends a Content, a plain struct without pointers, through a gate to one other object, in shared memory.
///
/// A Content belongs to the receiver from Send() until the receiver is ready for the next one. Nothing is queued.
///
/// @tparam REGIONS regions of memory that take turns. With 1, the next Content can be written when the receiver is
///   ready for it; with 2, already while the receiver works on the last one
template <typename Content, int REGIONS = 1>
class RegionSender {
 public:
  RegionSender() : subject_(NULL), next_(0), has_sent_(false), last_ticket_(0) {
    for (int i = 0; i < REGIONS; ++i) {
      regions_[i] = NULL;
    }
  }

  /// Call in DoInit, after NEW_ALL_SUBJECT_AND_OBSERVER.
  /// @param subject a gate with one observer; must outlive this
  /// @return false if the memory could not be allocated
  bool Create(OSubject* subject) {
    subject_ = subject;
    bool succeeds = true;
    for (int i = 0; i < REGIONS; ++i) {
      regions_[i] = new RCRegion(sizeof(Content));
      succeeds = succeeds && regions_[i]->Base() != NULL;
    }
    return succeeds;
  }

  /// Call in DoDestroy.
  void Destroy() {
    for (int i = 0; i < REGIONS; ++i) {
      if (regions_[i] != NULL) {
        regions_[i]->RemoveReference();
        regions_[i] = NULL;
      }
    }
  }

  /// False if the receiver has never been ready: OBJECT.CFG or CONNECT.CFG does not name it.
  bool HasReceiver() const { return has_sent_ || subject_->IsReady(); }

  /// True if the receiver is ready and there is Memory(), so that Send() may be called.
  bool IsFree() const { return subject_->IsReady() && Memory() != NULL; }

  /// Where the next Content goes: the same region until Send(), even if the receiver returns another one meanwhile.
  /// @return NULL if the receiver still has the region
  Content* Memory() const {
    RCRegion* const region = regions_[next_];
    return region->NumberOfReference() > 1 ? NULL : static_cast<Content*>(static_cast<void*>(region->Base()));
  }

  /// A new number for a job, by which its result is recognised; not 0.
  unsigned NewTicket() {
    ++last_ticket_;
    last_ticket_ += last_ticket_ == 0 ? 1 : 0;
    return last_ticket_;
  }

  /// Sends the Content in Memory(). Only if IsFree().
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
  int next_;  ///< the region that is written and sent next
  bool has_sent_;
  unsigned last_ticket_;
};

#endif  // AIBO_RCSERVER_OBJECTS_REGION_SENDER_H
