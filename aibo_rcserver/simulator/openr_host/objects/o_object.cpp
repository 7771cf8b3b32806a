#include <OPENR/OObject.h>

OObject::OObject() {}

OObject::~OObject() {}

OStatus OObject::DoInit(const OSystemEvent& /*event*/) {
  return oSUCCESS;
}

OStatus OObject::DoStart(const OSystemEvent& /*event*/) {
  return oSUCCESS;
}

OStatus OObject::DoStop(const OSystemEvent& /*event*/) {
  return oSUCCESS;
}

OStatus OObject::DoDestroy(const OSystemEvent& /*event*/) {
  return oSUCCESS;
}
