/// @file OSubject.h
#ifndef OPENR_OSUBJECT_H
#define OPENR_OSUBJECT_H

#include <OPENR/ObjcommEvent.h>

namespace openr_host {
class System;
class SubjectService;
}  // namespace openr_host

/// The sending end of a connection (Level2 Reference Guide, pages 12 to 23). A subject sends data to the observers that
/// CONNECT.CFG connects to it. An observer has one of these states:
///
/// - ASSERT-READY: it has asked for data. It gets the next notification at once, and then has no state.
/// - DEASSERT-READY: it wants no data. Its data is deleted.
/// - none: it is busy, or has not said anything yet. The newest notification is kept until it is ready. The SDK
///   can keep more, but nobody here asks for it.
class OSubject {
 public:
  OSubject();
  ~OSubject();

  /// Adds data to the next notification. The subject holds a reference until every observer is done with the data.
  /// Until then nobody may write to the region.
  OStatus SetData(RCRegion* region);
  /// Adds a copy of `size` bytes.
  OStatus SetData(const void* data, size_t size);

  /// Sends the data to every observer, depending on its state. Does nothing without data.
  OStatus NotifyObservers();

  /// Deletes the data that waits for observers (page 20).
  OStatus ClearBuffer();

  /// Not 0 if an observer has the state ASSERT-READY.
  int IsReady() const;

  /// Registers the subject for REGISTER_ALL_ENTRY.
  void Register(OID object, int index);

 private:
  friend class openr_host::System;
  OSubject(const OSubject&);
  OSubject& operator=(const OSubject&);

  openr_host::SubjectService* service_;
};

#endif  // OPENR_OSUBJECT_H
