#include "Nodder.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/OUnits.h>
#include <OPENR/core_macro.h>
#include <math.h>
#include <stdio.h>

namespace {

// The locators are those of Model Information ERS-7.
const char TOUCH[] = "PRM:/r1/c1/c2/c3/t1-Sensor:t1";
const char TILT[] = "PRM:/r1/c1/c2/c3-Joint2:13";
const int PRESSED = 9;

const int NOD_FRAMES = 8 * ocommandMAX_FRAMES;  // of 8 ms: a second
const double NOD_DEPTH = 20;                    // degrees

// The position of the head in a frame of the nod, relative to its beginning, in microradians.
slongword NodPosition(int frame) {
  return oradians(-NOD_DEPTH * (1 - cos(2 * 3.14159265 * frame / NOD_FRAMES)) / 2);
}

}  // namespace

Nodder::Nodder()
    : touch_(oprimitiveID_UNDEF),
      tilt_(oprimitiveID_UNDEF),
      rest_(0),
      next_frame_(NOD_FRAMES),
      was_touched_(false),
      nods_(0) {
  regions_[0] = regions_[1] = NULL;
}

OStatus Nodder::DoInit(const OSystemEvent&) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  if (OPENR::OpenPrimitive(TOUCH, &touch_) != oSUCCESS || OPENR::OpenPrimitive(TILT, &tilt_) != oSUCCESS ||
      !MakeRegions()) {
    OSYSLOG1((osyslogERROR, "this robot does not have the head of an ERS-7"));
    return oFAIL;
  }
  return oSUCCESS;
}

bool Nodder::MakeRegions() {
  for (int i = 0; i < REGIONS; ++i) {
    MemoryRegionID id = 0;
    OCommandVectorData* vector = 0;
    if (OPENR::NewCommandVectorData(1, &id, &vector) != oSUCCESS) {
      return false;
    }
    vector->SetNumData(1);
    vector->GetInfo(0)->Set(odataJOINT_COMMAND2, tilt_, ocommandMAX_FRAMES);
    regions_[i] = new RCRegion(id, vector->vectorInfo.offset, vector, vector->vectorInfo.totalSize);
  }
  return true;
}

OStatus Nodder::DoStart(const OSystemEvent&) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  return HoldHead() ? oSUCCESS : oFAIL;
}

// Switches the power and the gain on, because a joint keeps its position only with both.
bool Nodder::HoldHead() {
  OJointValue now;
  if (OPENR::GetJointValue(tilt_, &now) != oSUCCESS) {
    return false;
  }
  rest_ = now.value;
  OPENR::SetMotorPower(opowerON);
  return OPENR::EnableJointGain(tilt_) == oSUCCESS &&
         OPENR::SetJointGain(tilt_, 0x08, 0x04, 0x02, 0x0E, 0x02, 0x0F) == oSUCCESS;
}

OStatus Nodder::DoStop(const OSystemEvent&) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Nodder::DoDestroy(const OSystemEvent&) {
  for (int i = 0; i < REGIONS; ++i) {
    if (regions_[i] != NULL) {
      regions_[i]->RemoveReference();
    }
  }
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

void Nodder::NotifyTouch(const ONotifyEvent& event) {
  const bool is_touched = IsTouched(static_cast<OSensorFrameVectorData*>(const_cast<void*>(event.Data(0))));
  if (is_touched && !was_touched_ && next_frame_ == NOD_FRAMES) {
    BeginNod();
  }
  was_touched_ = is_touched;
  observer[event.ObsIndex()]->AssertReady();
}

bool Nodder::IsTouched(OSensorFrameVectorData* readings) const {
  for (longword i = 0; i < readings->vectorInfo.numData; ++i) {
    if (readings->GetInfo(static_cast<int>(i))->primitiveID == touch_) {
      return readings->GetData(static_cast<int>(i))->frame[0].value >= PRESSED;
    }
  }
  return false;
}

// Sends both vectors. With only one, the head would stop whenever that vector is over.
void Nodder::BeginNod() {
  OSYSPRINT(("Nodder: nod %d\n", nods_ + 1));
  next_frame_ = 0;
  for (int i = 0; i < REGIONS; ++i) {
    SendNextPart();
  }
}

void Nodder::ReadyHead(const OReadyEvent& event) {
  if (event.IsAssert() && next_frame_ < NOD_FRAMES) {
    SendNextPart();
    if (next_frame_ == NOD_FRAMES) {
      CountNod();
    }
  }
}

void Nodder::SendNextPart() {
  for (int i = 0; i < REGIONS; ++i) {
    if (regions_[i]->NumberOfReference() > 1) {
      continue;  // the vector is being played, or waits
    }
    OCommandVectorData* vector = reinterpret_cast<OCommandVectorData*>(regions_[i]->Base());
    OJointCommandValue2* values = reinterpret_cast<OJointCommandValue2*>(vector->GetData(0)->value);
    for (size_t frame = 0; frame < ocommandMAX_FRAMES; ++frame) {
      values[frame].value = rest_ + NodPosition(++next_frame_);
    }
    subject[sbjHead]->SetData(regions_[i]);
    subject[sbjHead]->NotifyObservers();
    return;
  }
}

void Nodder::CountNod() {
  FILE* file = fopen("/MS/NODS.TXT", "w");
  if (file == NULL) {
    OSYSLOG1((osyslogERROR, "NODS.TXT cannot be written: is the memory stick locked or full?"));
    return;
  }
  fprintf(file, "%d\n", ++nods_);
  fclose(file);
}
