/// @file OObserver.h
/// The end of a connection that data comes to (Level2 Reference Guide, pages 24 to 29).
#ifndef OPENR_OOBSERVER_H
#define OPENR_OOBSERVER_H

#include <OPENR/ObjcommEvent.h>

namespace openr_host {
class System;
class ObserverService;
}  // namespace openr_host

/// Tells its subjects when it is ready for data: one AssertReady() lets one notification through. What comes while it
/// is busy with that one waits at the subject (OSubject.h).
class OObserver {
 public:
  OObserver();
  ~OObserver();

  /// To all connected subjects.
  OStatus AssertReady();
  /// To one.
  OStatus AssertReady(const SubjectID& subject);

  /// To all connected subjects: what they send from now on is deleted, until the next AssertReady().
  OStatus DeassertReady();
  /// To one.
  OStatus DeassertReady(const SubjectID& subject);

  /// How subjects treat this observer's notifications. For DoInit().
  /// @param skip notifications left out after each one that is sent; 0 unless set
  /// @param min notifications that are sent together; 1 unless set
  /// @param max notifications that a subject keeps while the observer is not ready, not below `min`; 1 unless set
  void SetBufCtrlParam(size_t skip, size_t min, size_t max);
  void SetSkip(size_t skip) { SetBufCtrlParam(skip, 1, 1); }

  /// How many subjects CONNECT.CFG connects to this observer.
  int NumberOfSubjects() const;

  /// For REGISTER_ALL_ENTRY: makes the observer known as the one with this index in its object.
  void Register(OID object, int index);

 private:
  friend class openr_host::System;
  OObserver(const OObserver&);
  OObserver& operator=(const OObserver&);

  openr_host::ObserverService* service_;
};

#endif  // OPENR_OOBSERVER_H
