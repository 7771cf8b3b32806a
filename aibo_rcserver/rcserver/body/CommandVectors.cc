#include "rcserver/body/CommandVectors.h"

#include <OPENR/OPENRAPI.h>

namespace {

OCommandVectorData* VectorIn(RCRegion* region) {
  void* base = region->Base();
  return static_cast<OCommandVectorData*>(base);
}

}  // namespace

const int CommandVectors::FRAMES;
const int CommandVectors::NUMBER_OF_VECTORS;

CommandVectors::CommandVectors() {
  for (int i = 0; i < NUMBER_OF_VECTORS; ++i) {
    memories_[i] = MemoryRegionID();
    regions_[i] = NULL;
  }
}

bool CommandVectors::Create(int most_entries) {
  for (int i = 0; i < NUMBER_OF_VECTORS; ++i) {
    OCommandVectorData* vector = NULL;
    if (OPENR::NewCommandVectorData(static_cast<size_t>(most_entries), &memories_[i], &vector) != oSUCCESS) {
      Destroy();
      return false;
    }
    regions_[i] =
        new RCRegion(vector->vectorInfo.memRegionID, vector->vectorInfo.offset, vector, vector->vectorInfo.totalSize);
  }
  return true;
}

void CommandVectors::Destroy() {
  for (int i = 0; i < NUMBER_OF_VECTORS; ++i) {
    if (regions_[i] != NULL) {
      regions_[i]->RemoveReference();
      OPENR::DeleteCommandVectorData(memories_[i]);
      regions_[i] = NULL;
    }
  }
}

RCRegion* CommandVectors::FindFree() {
  for (int i = 0; i < NUMBER_OF_VECTORS; ++i) {
    if (regions_[i] != NULL && regions_[i]->NumberOfReference() == 1) {
      return regions_[i];
    }
  }
  return NULL;
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
