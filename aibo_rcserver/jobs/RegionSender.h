/// @file RegionSender.h
/// How one object of ours hands another one a job, or its result.
#ifndef JOBS_REGION_SENDER_H
#define JOBS_REGION_SENDER_H

#include <OPENR/OSubject.h>
#include <OPENR/RCRegion.h>

/// Sends a Content, a plain struct without pointers, through a gate to one other object, in one piece of shared memory.
///
/// The memory belongs to the receiver until it has said that it is ready for more. Nothing is ever queued.
template <typename Content>
class RegionSender {
 public:
  RegionSender() : subject_(NULL), region_(NULL), last_ticket_(0) {}

  /// To be called in DoInit, behind NEW_ALL_SUBJECT_AND_OBSERVER.
  /// @param subject a gate with one observer; must outlive this
  /// @return false if there is no memory
  bool Create(OSubject* subject) {
    subject_ = subject;
    region_ = new RCRegion(sizeof(Content));
    return region_->Base() != NULL;
  }

  /// To be called in DoDestroy.
  void Destroy() {
    if (region_ != NULL) {
      region_->RemoveReference();
      region_ = NULL;
    }
  }

  /// True if the receiver is ready and has done with what was sent last. Only then may Memory() be written and sent.
  bool IsFree() const { return region_->NumberOfReference() == 1 && subject_->IsReady(); }

  Content* Memory() const {
    void* const base = region_->Base();
    return static_cast<Content*>(base);
  }

  /// A number for a job by which its result is known. No job of late has had it; not 0.
  unsigned NewTicket() {
    ++last_ticket_;
    last_ticket_ += last_ticket_ == 0 ? 1 : 0;
    return last_ticket_;
  }

  void Send() {
    subject_->SetData(region_);
    subject_->NotifyObservers();
  }

 private:
  RegionSender(const RegionSender&);
  RegionSender& operator=(const RegionSender&);

  OSubject* subject_;
  RCRegion* region_;
  unsigned last_ticket_;
};

#endif  // JOBS_REGION_SENDER_H
