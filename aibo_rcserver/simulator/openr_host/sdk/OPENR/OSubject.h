/// @file OSubject.h
/// The end of a connection that data leaves from (Level2 Reference Guide, pages 12 to 23).
#ifndef OPENR_OSUBJECT_H
#define OPENR_OSUBJECT_H

#include <OPENR/ObjcommEvent.h>

namespace openr_host {
class System;
class SubjectService;
}  // namespace openr_host

/// Sends data to the observers that CONNECT.CFG connects to it. Each of them is in one of three states:
///
/// - ASSERT-READY: it has asked for data. It gets the next notification at once, and is in neither state then.
/// - DEASSERT-READY: it wants no data. What it is sent is deleted.
/// - neither: it is busy, or has not spoken yet. Notifications are kept for it until it is ready, but only the newest
///   one, unless SetBufferSize() or OObserver::SetBufCtrlParam() says how many.
class OSubject {
 public:
  OSubject();
  ~OSubject();

  /// Adds data to what the next NotifyObservers() or NotifyObserver() sends to all. The subject adds a reference of
  /// its own, and removes it when every observer is done with the data. The region must not be written to until then.
  OStatus SetData(RCRegion* region);
  /// The same for one observer alone.
  OStatus SetData(const ObserverID& observer, RCRegion* region);
  /// The same with a copy of `size` bytes.
  OStatus SetData(const void* data, size_t size);

  /// Sends what was set to every observer, as its state says. Nothing is sent without data, or before Enable().
  OStatus NotifyObservers();
  /// Sends what was set to this one observer, as its state says. What was set for all stays set for the others.
  OStatus NotifyObserver(const ObserverID& observer);

  /// Not 0 if an observer is in the state ASSERT-READY.
  int IsReady() const { return IsAnyReady(); }
  /// Not 0 if this observer is in the state ASSERT-READY.
  int IsReady(const ObserverID& observer) const;
  int IsAnyReady() const;
  /// Not 0 if one is in the state ASSERT-READY and none in neither state.
  int IsAllReady() const;
  /// Above 0: ASSERT-READY; 0: neither; below 0: DEASSERT-READY.
  int ReadyStatus(const ObserverID& observer) const;

  /// Notifications that are kept for each observer that is in neither state; 1 unless set. For DoInit().
  /// @return oINVALID_ARG for 0
  OStatus SetBufferSize(size_t size);
  size_t GetBufferSize() const;
  /// How many more notifications can be kept for this observer before the oldest one is lost.
  size_t RemainBuffer(const ObserverID& observer) const;

  /// Forgets what was set or kept and not yet sent.
  OStatus ClearBuffer();

  /// For REGISTER_ALL_ENTRY: makes the subject known as the one with this index in its object.
  void Register(OID object, int index);
  /// For ENABLE_ALL_SUBJECT and DISABLE_ALL_SUBJECT.
  void Enable(bool enabled);

 private:
  friend class openr_host::System;
  OSubject(const OSubject&);
  OSubject& operator=(const OSubject&);

  openr_host::SubjectService* service_;
};

#endif  // OPENR_OSUBJECT_H
