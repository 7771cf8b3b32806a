/// @file OObserver.h
#ifndef OPENR_OOBSERVER_H
#define OPENR_OOBSERVER_H

#include <OPENR/ObjcommEvent.h>

namespace openr_host {
class System;
class ObserverService;
}  // namespace openr_host

/// The receiving end of a connection (Level2 Reference Guide, pages 24 to 29). Each AssertReady() lets one notification
/// through. Until the next one, data waits at the subject (OSubject.h).
class OObserver {
 public:
  OObserver();
  ~OObserver();

  /// Tells all connected subjects that the observer is ready.
  OStatus AssertReady();
  OStatus AssertReady(const SubjectID& subject);

  /// Tells all connected subjects to delete what they send until the next AssertReady().
  OStatus DeassertReady();
  OStatus DeassertReady(const SubjectID& subject);

  /// Registers the observer for REGISTER_ALL_ENTRY.
  void Register(OID object, int index);

 private:
  friend class openr_host::System;
  OObserver(const OObserver&);
  OObserver& operator=(const OObserver&);

  openr_host::ObserverService* service_;
};

#endif  // OPENR_OOBSERVER_H
