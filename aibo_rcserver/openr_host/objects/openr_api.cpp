#include <OPENR/OPENRAPI.h>

#include "openr_host/system.h"

using openr_host::System;

OStatus OPENR::OpenPrimitive(const char* locator, OPrimitiveID* primitiveID) {
  return System::current().robot().openPrimitive(locator, primitiveID);
}

OStatus OPENR::ClosePrimitive(OPrimitiveID primitiveID) {
  return System::current().robot().closePrimitive(primitiveID);
}

OStatus OPENR::ControlPrimitive(OPrimitiveID primitiveID, OPrimitiveRequest request, void* param, size_t paramSize,
                                void* result, size_t resultSize) {
  return System::current().robot().controlPrimitive(primitiveID, request, param, paramSize, result, resultSize);
}

OStatus OPENR::GetRobotDesign(char* design) {
  const std::string name = System::current().robot().design();
  design[name.copy(design, orobotdesignNAME_MAX - 1)] = '\0';
  return oSUCCESS;
}
