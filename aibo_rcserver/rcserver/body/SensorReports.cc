#include "rcserver/body/SensorReports.h"

bool SensorReports::Next() {
  while (++entry_ < static_cast<int>(vector_->vectorInfo.numData)) {
    row_ = primitives_.Find(Info().primitiveID);
    if (row_ != Primitives::NOT_OPEN && Info().numFrames > 0) {
      return true;
    }
  }
  return false;
}
