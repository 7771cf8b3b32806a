#include "rcserver/body/Primitives.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>

const int Primitives::MAX_ROWS;
const int Primitives::NOT_OPEN;

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
