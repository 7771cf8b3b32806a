/// @file OSubject.h
/// The end of a connection that data leaves from.
#ifndef OPENR_OSUBJECT_H
#define OPENR_OSUBJECT_H

#include <OPENR/ObjcommEvent.h>

namespace openr_host {
class System;
class SubjectService;
}  // namespace openr_host

/// Sends data to the observers that CONNECT.CFG connects to it, but only to those that are ready. An observer that was
/// sent something is ready again only after its next AssertReady().
class OSubject {
 public:
  OSubject();
  ~OSubject();

  /// Adds data to what the next NotifyObservers() or NotifyObserver() sends to all. The subject adds a reference of
  /// its own, and removes it when the data has been sent.
  void SetData(RCRegion* region);
  /// The same for one observer alone.
  void SetData(const ObserverID& observer, RCRegion* region);
  /// The same with a copy of `size` bytes.
  void SetData(const void* data, size_t size);

  /// Sends what was set to every ready observer and forgets it. Without data, or with the subject not enabled, nothing
  /// is sent.
  void NotifyObservers();
  /// Sends what was set to this one observer, if it is ready. What was set for all stays set for the others.
  void NotifyObserver(const ObserverID& observer);

  bool IsReady() const { return IsAnyReady(); }
  bool IsReady(const ObserverID& observer) const;
  bool IsAnyReady() const;
  /// False if nothing is connected.
  bool IsAllReady() const;

  /// Forgets what was set and not yet sent.
  void ClearBuffer();

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
