/// @file OObserver.h
/// The receiving end of a connection (Level2 Reference Guide, pages 24 to 29).
#ifndef OPENR_OOBSERVER_H
#define OPENR_OOBSERVER_H

#include <OPENR/ObjcommEvent.h>

namespace openr_host {
class System;
class ObserverService;
}  // namespace openr_host

/// Tells its subjects when it is ready for data: one AssertReady() lets one notification through. Until the next one,
/// data waits at the subject (OSubject.h).
class OObserver {
 public:
  OObserver();
  ~OObserver();

  /// To all connected subjects.
  OStatus AssertReady();
  /// To one subject.
  OStatus AssertReady(const SubjectID& subject);

  /// To all connected subjects: everything that they send is deleted until the next AssertReady().
  OStatus DeassertReady();
  /// To one subject.
  OStatus DeassertReady(const SubjectID& subject);

  /// Sets how subjects treat this observer's notifications. For use in DoInit().
  /// @param skip notifications to leave out after each one that is sent; default 0
  /// @param min notifications to send together; default 1
  /// @param max notifications that a subject keeps while the observer is not ready, at least `min`; default 1
  void SetBufCtrlParam(size_t skip, size_t min, size_t max);
  void SetSkip(size_t skip) { SetBufCtrlParam(skip, 1, 1); }

  /// The number of subjects that CONNECT.CFG connects to this observer.
  int NumberOfSubjects() const;

  /// For REGISTER_ALL_ENTRY: registers the observer under its index in the object.
  void Register(OID object, int index);

 private:
  friend class openr_host::System;
  OObserver(const OObserver&);
  OObserver& operator=(const OObserver&);

  openr_host::ObserverService* service_;
};

#endif  // OPENR_OOBSERVER_H
