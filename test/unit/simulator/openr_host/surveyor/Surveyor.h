/// @file Surveyor.h
/// An object like old code for the robot: it uses all of namespace std, and relies on indirect includes of the SDK's
/// headers.
#ifndef TEST_UNIT_SIMULATOR_OPENR_HOST_SURVEYOR_SURVEYOR_H
#define TEST_UNIT_SIMULATOR_OPENR_HOST_SURVEYOR_SURVEYOR_H

#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>

#include <list>

#include "def.h"

using namespace std;  // NOLINT(google-build-using-namespace,google-global-names-in-headers): as old code does

class Surveyor : public OObject {
 public:
  Surveyor() : height(0) {}

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

  void Ready(const OReadyEvent& event);
  void Notify(const ONotifyEvent& event);

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

 private:
  byte height;
  list<byte> heights;
};

#endif  // TEST_UNIT_SIMULATOR_OPENR_HOST_SURVEYOR_SURVEYOR_H
