/// @file stub.h
/// An object's stub.cfg, and the sources that are generated from it.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_STUB_GENERATOR_STUB_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_STUB_GENERATOR_STUB_H

#include <istream>
#include <string>
#include <vector>

#include "simulator/openr_host/configuration/text.h"

namespace openr_host {

/// A line that begins with Service.
struct StubService {
  ServiceName name;
  std::string connection_function;  ///< called when the service is connected; empty for null
  std::string data_function;        ///< called for a message or a ready event; empty for null
};

/// The names of an object's gates and entry points.
struct StubConfiguration {
  std::string object_name;
  std::vector<StubService> subjects;
  std::vector<StubService> observers;
  std::vector<std::string> extra_functions;
};

/// Reads a stub.cfg (OPEN-R SDK Programmer's Guide, 2.3), one setting per line. Other lines, such as comments, are
/// skipped. A service's first word is usually the object's name, but need not be.
/// @param file its name, for errors
/// @throw ConfigurationError if a setting is malformed, if NumOfOSubject or NumOfOObserver is 0 or does not match the
/// number of services, or if two services or extra functions have the same name
StubConfiguration readStub(std::istream& text, const std::string& file);

/// def.h: numOfSubject, numOfObserver, and the indexes sbjNAME and obsNAME. The SDK's stubgen2 makes the same.
std::string writeDef(const StubConfiguration& stub);

/// entry.h: the indexes entryNAME into Extra_Entry. The SDK's stubgen2 makes the same.
std::string writeEntry(const StubConfiguration& stub);

/// OBJECTNAME_stub.h: declares describeOBJECTNAME(), for MachineOptions::catalog.
std::string writeDescriptionHeader(const StubConfiguration& stub);

/// OBJECTNAME_stub.cc: defines describeOBJECTNAME(). Expects the class OBJECTNAME in OBJECTNAME.h.
/// @param priority from the object's .ocf, 0..255
std::string writeDescription(const StubConfiguration& stub, int priority);

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_STUB_GENERATOR_STUB_H
