#include "Surveyor.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/core_macro.h>

OStatus Surveyor::DoInit(const OSystemEvent&) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  return oSUCCESS;
}

OStatus Surveyor::DoStart(const OSystemEvent&) {
  ODesignDataID id = odesigndataID_UNDEF;
  byte* data = NULL;
  size_t size = 0;
  if (OPENR::FindDesignData("PLACE", &id, &data, &size) == oSUCCESS) {
    char text[4] = "";  // the data has no 0 at its end
    memcpy(text, data, size < sizeof(text) ? size : sizeof(text) - 1);
    height = static_cast<byte>(atoi(text));
    OPENR::DeleteDesignData(id);
  }
  OSYSPRINT(("Surveyor at %d\n", height));
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Surveyor::DoStop(const OSystemEvent&) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Surveyor::DoDestroy(const OSystemEvent&) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

void Surveyor::Ready(const OReadyEvent& event) {
  if (event.IsAssert() && heights.empty()) {
    RCRegion* region = new RCRegion(sizeof(height));
    memcpy(region->Base(), &height, sizeof(height));
    subject[sbjMap]->SetData(region);
    subject[sbjMap]->NotifyObservers();
    region->RemoveReference();
  }
}

void Surveyor::Notify(const ONotifyEvent& event) {
  heights.push_back(*static_cast<const byte*>(event.Data(0)));
  OSYSPRINT(("Surveyor hears of %d\n", heights.back()));
  observer[event.ObsIndex()]->AssertReady();
}
