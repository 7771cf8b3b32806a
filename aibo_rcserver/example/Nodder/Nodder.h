/// @file Nodder.h
/// An example of an OPEN-R object (docs/openr.md). It compiles with Sony's headers, too. No robot has run it.
#ifndef AIBO_RCSERVER_EXAMPLE_NODDER_NODDER_H
#define AIBO_RCSERVER_EXAMPLE_NODDER_NODDER_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include <OPENR/RCRegion.h>

#include "def.h"

/// Nods when somebody touches its head, and counts the nods in NODS.TXT on the memory stick.
class Nodder : public OObject {
 public:
  Nodder();

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

  /// Called when sensors have been read, every 32 ms.
  void NotifyTouch(const ONotifyEvent& event);

  /// Called when a command vector has been played.
  void ReadyHead(const OReadyEvent& event);

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

 private:
  static const int REGIONS = 2;  ///< one region is played while the other one waits

  bool MakeRegions();
  bool HoldHead();
  bool IsTouched(OSensorFrameVectorData* readings) const;
  void BeginNod();
  void SendNextPart();
  void CountNod();

  OPrimitiveID touch_;
  OPrimitiveID tilt_;
  RCRegion* regions_[REGIONS];
  slongword rest_;  ///< the head's position between nods, in microradians
  int next_frame_;  ///< the next frame of the nod; NOD_FRAMES between nods
  bool was_touched_;
  int nods_;
};

#endif  // AIBO_RCSERVER_EXAMPLE_NODDER_NODDER_H
