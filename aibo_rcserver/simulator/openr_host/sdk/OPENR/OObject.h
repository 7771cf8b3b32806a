/// @file OObject.h
#ifndef OPENR_OOBJECT_H
#define OPENR_OOBJECT_H

#include <OPENR/OPENR.h>
#include <OPENR/OPENREvent.h>

namespace openr_host {
class System;
}

/// The base class of all OPEN-R objects. The derived class has the members `OSubject* subject[numOfSubject]` and
/// `OObserver* observer[numOfObserver]` (def.h) and the functions named in stub.cfg, all public.
///
/// The machine calls one function at a time and waits until it returns, so objects need no locks and must not block.
class OObject {
 public:
  OObject();
  virtual ~OObject();

  /// All objects are initialised before any is connected or started. Anything but oSUCCESS ends the boot.
  virtual OStatus DoInit(const OSystemEvent& event);
  /// Called when all objects are connected.
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  /// Called when all objects are stopped.
  virtual OStatus DoDestroy(const OSystemEvent& event);

 protected:
  OID myOID_;  ///< valid from DoInit() on

 private:
  friend class openr_host::System;
  OObject(const OObject&);
  OObject& operator=(const OObject&);
};

#endif  // OPENR_OOBJECT_H
