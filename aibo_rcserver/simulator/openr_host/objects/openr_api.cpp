// The SDK's functions: OPENR::, the IPStack's calls, and the console.
#include <MCOOP.h>
#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <ant.h>

#include <chrono>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <stdexcept>
#include <string>

#include "simulator/openr_host/objects/system.h"

using openr_host::System;

namespace {

/// The part of the text that the console shows.
std::string format(const char* format, std::va_list arguments) {
  char text[osyslogMAX_SIZE];
  const int size = std::vsnprintf(text, sizeof(text), format, arguments);
  return size > 0 ? text : "";
}

/// Prints a text, even from an object in a test without a machine.
void print(const std::string& text) {
  if (auto* system = System::currentOrNull()) {
    system->console().print(text);
  } else {
    std::cout << text << std::flush;
  }
}

const char* nameOf(OSyslogPriority priority) {
  switch (priority) {
    case osyslogERROR:
      return "ERROR";
    case osyslogWARNING:
      return "WARNING";
    default:
      return "INFO";
  }
}

}  // namespace

sError GetSystemTime(SystemTime* time) {
  const auto now = System::current().now();
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(now);
  time->seconds = static_cast<longword>(seconds.count());
  time->useconds = static_cast<longword>(std::chrono::duration_cast<std::chrono::microseconds>(now - seconds).count());
  return sSUCCESS;
}

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

OStatus OPENR::NewCommandVectorData(size_t count, MemoryRegionID* memID, OCommandVectorData** vector) {
  OCommandVectorData* created = System::current().vectorMemory().createCommands(count);
  if (created == nullptr) {
    return oNO_MEMORY;
  }
  *memID = created->vectorInfo.memRegionID;
  *vector = created;
  return oSUCCESS;
}

OStatus OPENR::DeleteCommandVectorData(MemoryRegionID memID) {
  return System::current().vectorMemory().destroy(memID, odataCOMMAND_VECTOR) ? oSUCCESS : oFAIL;
}

OStatus OPENR::NewSoundVectorData(size_t numSounds, size_t dataSize, MemoryRegionID* memID,
                                  OSoundVectorData** baseAddr) {
  OSoundVectorData* created = System::current().vectorMemory().createSounds(numSounds, dataSize);
  if (created == nullptr) {
    return oNO_MEMORY;
  }
  *memID = created->vectorInfo.memRegionID;
  *baseAddr = created;
  return oSUCCESS;
}

OStatus OPENR::DeleteSoundVectorData(MemoryRegionID memID) {
  return System::current().vectorMemory().destroy(memID, odataSOUND_VECTOR) ? oSUCCESS : oINVALID_ARG;
}

OStatus OPENR::NewCdtVectorData(MemoryRegionID* memID, OCdtVectorData** vector) {
  *vector = System::current().vectorMemory().createCdt();
  *memID = (*vector)->vectorInfo.memRegionID;
  return oSUCCESS;
}

OStatus OPENR::DeleteCdtVectorData(MemoryRegionID memID) {
  return System::current().vectorMemory().destroy(memID, odataCDT_VECTOR) ? oSUCCESS : oFAIL;
}

OStatus OPENR::SetCdtVectorData(MemoryRegionID memID) {
  System& system = System::current();
  const OCdtVectorData* const tables = system.vectorMemory().findCdt(memID);
  if (tables == nullptr) {
    return oFAIL;
  }
  if (tables->vectorInfo.type != odataCDT_VECTOR) {
    return oINVALID_DATA_TYPE;
  }
  return tables->vectorInfo.numData <= ocdtNUM_CHANNELS ? system.robot().setCdtVectorData(*tables) : oFAIL;
}

OStatus OPENR::NewSyncKey(OVRSyncKey* key) {
  *key = ovrsynckeyUNDEF;
  return oNO_SYNC_KEY;
}

OStatus OPENR::DivideSyncKey(OVRSyncKey /*key*/, OVRSyncKey* key1, OVRSyncKey* key2) {
  *key1 = ovrsynckeyUNDEF;
  *key2 = ovrsynckeyUNDEF;
  return oINVALID_SYNC_KEY;
}

OStatus OPENR::FindDesignData(const char* keyword, ODesignDataID* dataID, byte** data, size_t* size) {
  try {
    return System::current().designData().find(keyword, dataID, data, size);
  } catch (const std::runtime_error& error) {
    OSYSLOG1((osyslogERROR, "FindDesignData: %s", error.what()));
    return oFAIL;
  }
}

OStatus OPENR::DeleteDesignData(ODesignDataID dataID) {
  return System::current().designData().release(dataID) ? oSUCCESS : oINVALID_ARG;
}

OStatus OPENR::SetJointGain(OPrimitiveID primitiveID, word pg, word ig, word dg, word ps, word is, word ds) {
  return System::current().robot().setJointGain(primitiveID, pg, ig, dg, ps, is, ds);
}

OStatus OPENR::SetDefaultJointGain(OPrimitiveID primitiveID) {
  return System::current().robot().setDefaultJointGain(primitiveID);
}

OStatus OPENR::EnableJointGain(OPrimitiveID primitiveID) {
  return System::current().robot().enableJointGain(primitiveID);
}

OStatus OPENR::DisableJointGain(OPrimitiveID primitiveID) {
  return System::current().robot().disableJointGain(primitiveID);
}

OStatus OPENR::GetJointValue(OPrimitiveID primitiveID, OJointValue* value) {
  return System::current().robot().getJointValue(primitiveID, value);
}

OStatus OPENR::GetSensorValue(OPrimitiveID primitiveID, OSensorValue* value) {
  return System::current().robot().getSensorValue(primitiveID, value);
}

OStatus OPENR::SetMotorPower(OPower power) {
  return System::current().robot().setMotorPower(power);
}

OStatus OPENR::GetPowerStatus(OPowerStatus* status) {
  return System::current().robot().getPowerStatus(status);
}

OStatus OPENR::ObservePowerStatus(const OPowerStatus& notifyStatus, const OServiceEntry& entry) {
  return System::current().observePower(notifyStatus, entry);
}

OStatus OPENR::UnobservePowerStatus(const OServiceEntry& entry) {
  return System::current().unobservePower(entry);
}

OStatus OPENR::GetVolumeSwitch(OVolumeSwitch* volSW) {
  *volSW = System::current().robot().volumeSwitch();
  return oSUCCESS;
}

OStatus OPENR::GetMemoryStickStatus(OMemoryStickStatus* status) {
  return System::current().robot().getMemoryStickStatus(status);
}

OStatus OPENR::Shutdown(const OBootCondition& condition) {
  const bool boots_again = (condition.bitmap & obcbBOOT_TIMER) != 0;
  if (boots_again && (condition.bootTimeType != obcbttRELATIVE || condition.bootTime != 0)) {
    return oINVALID_ARG;
  }
  System::current().requestShutdown(boots_again);
  return oSUCCESS;
}

OStatus OPENR::GetRobotDesign(char* design) {
  const std::string name = System::current().robot().design();
  design[name.copy(design, orobotdesignNAME_MAX)] = '\0';
  return oSUCCESS;
}

antStackRef::antStackRef(const char* name) : is_ip_stack_(std::strcmp(name, "IPStack") == 0) {}

antError antEnvMsg::Call(const antStackRef& stack, size_t size) {
  return stack.IsIPStack() ? System::current().ipStack().call(*this, size) : ANT_FAIL;
}

antError antEnvMsg::Send(const antStackRef& stack, const OID& object, Selector entry, size_t size) {
  System& system = System::current();
  if (!stack.IsIPStack() || !system.hasEntry(object, entry)) {
    return ANT_FAIL;
  }
  return system.ipStack().send(*this, size, object, entry);
}

OStatus osysprint(const char* format_text, ...) {
  std::va_list arguments;
  va_start(arguments, format_text);
  print(format(format_text, arguments));
  va_end(arguments);
  return oSUCCESS;
}

OStatus osyslog(OSyslogPriority priority, const char* format_text, ...) {
  std::va_list arguments;
  va_start(arguments, format_text);
  const std::string text = format(format_text, arguments);
  va_end(arguments);
  const auto* system = System::currentOrNull();
  const std::string object = system != nullptr ? system->runningObject() + ": " : "";
  print(std::string(nameOf(priority)) + " " + object + text + "\n");
  return oSUCCESS;
}
