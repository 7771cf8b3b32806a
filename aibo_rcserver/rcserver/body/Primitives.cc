#include "rcserver/body/Primitives.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>

namespace {

OCommandVectorData* VectorIn(RCRegion* region) {
  void* base = region->Base();
  return static_cast<OCommandVectorData*>(base);
}

}  // namespace

const int Primitives::MAX_ROWS;
const int Primitives::NOT_OPEN;
const int CommandVectors::FRAMES;

Primitives::Primitives() {
  for (int i = 0; i < MAX_ROWS; ++i) {
    ids_[i] = oprimitiveID_UNDEF;
  }
}

bool Primitives::Open(int row, const char* name, const char* locator) {
  OPrimitiveID id = oprimitiveID_UNDEF;
  const OStatus status = OPENR::OpenPrimitive(locator, &id);
  if (status != oSUCCESS) {
    OSYSLOG1(
        (osyslogERROR, "RCServer: %s (%s) does not open (status %u)", name, locator, static_cast<unsigned>(status)));
    return false;
  }
  ids_[row] = id;
  return true;
}

void Primitives::Close() {
  for (int i = 0; i < MAX_ROWS; ++i) {
    if (IsOpen(i)) {
      OPENR::ClosePrimitive(ids_[i]);
      ids_[i] = oprimitiveID_UNDEF;
    }
  }
}

int Primitives::Find(OPrimitiveID id) const {
  for (int i = 0; i < MAX_ROWS; ++i) {
    if (IsOpen(i) && ids_[i] == id) {
      return i;
    }
  }
  return NOT_OPEN;
}

bool SensorReports::Next() {
  while (++entry_ < static_cast<int>(vector_->vectorInfo.numData)) {
    row_ = primitives_.Find(Info().primitiveID);
    if (row_ != Primitives::NOT_OPEN && Info().numFrames > 0) {
      return true;
    }
  }
  return false;
}

CommandVectors::CommandVectors() : VectorPair(OPENR::DeleteCommandVectorData) {}

bool CommandVectors::Create(int most_entries) {
  for (int i = 0; i < SIZE; ++i) {
    MemoryRegionID memory = MemoryRegionID();
    OCommandVectorData* vector = NULL;
    if (OPENR::NewCommandVectorData(static_cast<size_t>(most_entries), &memory, &vector) != oSUCCESS) {
      return false;
    }
    Own(i, memory, vector);
  }
  return true;
}

void CommandVectors::Clear(RCRegion* vector) {
  VectorIn(vector)->SetNumData(0);
}

OCommandData* CommandVectors::Add(RCRegion* vector, ODataType type, OPrimitiveID primitive, int frames) {
  OCommandVectorData* data = VectorIn(vector);
  const longword entry = data->vectorInfo.numData;
  data->SetNumData(entry + 1);
  data->GetInfo(static_cast<int>(entry))->Set(type, primitive, static_cast<size_t>(frames));
  return data->GetData(static_cast<int>(entry));
}
