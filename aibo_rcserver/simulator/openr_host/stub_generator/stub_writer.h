/// @file stub_writer.h
/// The sources that are made from a stub.cfg.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_STUB_GENERATOR_STUB_WRITER_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_STUB_GENERATOR_STUB_WRITER_H

#include <string>

#include "simulator/openr_host/configuration/stub_configuration.h"

namespace openr_host {

/// def.h: numOfSubject, numOfObserver, and the indexes sbjNAME and obsNAME. The SDK's stubgen2 makes the same.
std::string writeDef(const StubConfiguration& stub);

/// entry.h: the indexes entryNAME into Extra_Entry. The SDK's stubgen2 makes the same.
std::string writeEntry(const StubConfiguration& stub);

/// OBJECTNAME_stub.h: declares describeOBJECTNAME(), for MachineOptions::catalog.
std::string writeDescriptionHeader(const StubConfiguration& stub);

/// OBJECTNAME_stub.cc: defines it, and expects the class OBJECTNAME in OBJECTNAME.h.
/// @param priority of the object's .ocf, 0..255
std::string writeDescription(const StubConfiguration& stub, int priority);

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_STUB_GENERATOR_STUB_WRITER_H
