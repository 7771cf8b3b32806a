/// @file OObserver.h
/// The end of a connection that data comes to.
#ifndef OPENR_OOBSERVER_H
#define OPENR_OOBSERVER_H

#include <OPENR/ObjcommEvent.h>

namespace openr_host {
class System;
class ObserverService;
}  // namespace openr_host

/// Tells its subjects when it is ready for data: one AssertReady() lets one notification through. Data that a subject
/// has while the observer is not ready never reaches it.
class OObserver {
 public:
  OObserver();
  ~OObserver();

  /// To all connected subjects.
  void AssertReady();
  /// To one.
  void AssertReady(const SubjectID& subject);

  /// To all connected subjects.
  void DeassertReady();
  /// To one.
  void DeassertReady(const SubjectID& subject);

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
