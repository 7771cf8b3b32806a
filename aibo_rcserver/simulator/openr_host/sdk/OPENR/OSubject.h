/// @file OSubject.h
/// The sending end of a connection (Level2 Reference Guide, pages 12 to 23).
#ifndef OPENR_OSUBJECT_H
#define OPENR_OSUBJECT_H

#include <OPENR/ObjcommEvent.h>

namespace openr_host {
class System;
class SubjectService;
}  // namespace openr_host

/// Sends data to the observers that CONNECT.CFG connects to it. Each of them is in one of three states:
///
/// - ASSERT-READY: it has asked for data. It gets the next notification at once, and is then in neither state.
/// - DEASSERT-READY: it wants no data. Data for it is deleted.
/// - neither: it is busy, or has not said anything yet. Notifications are kept for it until it is ready, by default
///   only the newest one; SetBufferSize() and OObserver::SetBufCtrlParam() change the number.
class OSubject {
 public:
  OSubject();
  ~OSubject();

  /// Adds data to the next notification of all observers. The subject adds a reference of its own, and removes it when
  /// every observer is done with the data. Until then the region must not be written to.
  OStatus SetData(RCRegion* region);
  /// The same for one observer only.
  OStatus SetData(const ObserverID& observer, RCRegion* region);
  /// The same with a copy of `size` bytes.
  OStatus SetData(const void* data, size_t size);

  /// Sends the data that was set to every observer, depending on its state. Without data, or before Enable(), does
  /// nothing.
  OStatus NotifyObservers();
  /// Sends the data that was set to this one observer, depending on its state. It stays set for the others.
  OStatus NotifyObserver(const ObserverID& observer);

  /// Not 0 if an observer is in the state ASSERT-READY.
  int IsReady() const { return IsAnyReady(); }
  /// Not 0 if this observer is in the state ASSERT-READY.
  int IsReady(const ObserverID& observer) const;
  int IsAnyReady() const;
  /// Not 0 if at least one observer is in the state ASSERT-READY and all others are in one of the two states.
  int IsAllReady() const;
  /// Above 0: ASSERT-READY; 0: neither; below 0: DEASSERT-READY.
  int ReadyStatus(const ObserverID& observer) const;

  /// Sets how many notifications are kept for each observer that is in neither state; default 1. For use in DoInit().
  /// @return oINVALID_ARG for 0
  OStatus SetBufferSize(size_t size);
  size_t GetBufferSize() const;
  /// The number of notifications that can still be kept for this observer before the oldest one is lost.
  size_t RemainBuffer(const ObserverID& observer) const;

  /// Drops all data that was set or kept and not yet sent.
  OStatus ClearBuffer();

  /// For REGISTER_ALL_ENTRY: registers the subject under its index in the object.
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
