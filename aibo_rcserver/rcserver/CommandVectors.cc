#include "rcserver/CommandVectors.h"

#include <OPENR/OPENRAPI.h>
#include <string.h>

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
    memories_[i] = memoryRegionID_UNDEF;
    regions_[i] = NULL;
  }
}

bool CommandVectors::Create(const OPrimitiveID* joints, int number_of_joints) {
  for (int i = 0; i < NUMBER_OF_VECTORS; ++i) {
    OCommandVectorData* vector = NULL;
    if (OPENR::NewCommandVectorData(static_cast<size_t>(number_of_joints), &memories_[i], &vector) != oSUCCESS) {
      Destroy();
      return false;
    }
    vector->SetNumData(static_cast<size_t>(number_of_joints));
    for (int joint = 0; joint < number_of_joints; ++joint) {
      vector->GetInfo(joint)->Set(odataJOINT_COMMAND2, joints[joint], FRAMES);
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

void CommandVectors::Set(RCRegion* vector, int joint, int frame, int position) {
  OJointCommandValue2 value;
  value.value = position;
  value.padding = 0;
  memcpy(&VectorIn(vector)->GetData(joint)->value[frame], &value, sizeof(value));
}
