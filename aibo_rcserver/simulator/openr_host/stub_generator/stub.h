/// @file stub.h
/// An object's stub.cfg, and the sources generated from it.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_STUB_GENERATOR_STUB_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_STUB_GENERATOR_STUB_H

#include <istream>
#include <string>
#include <vector>

#include "simulator/openr_host/configuration/text.h"

namespace openr_host {

struct StubService {
  ServiceName name;
  std::string connection_function;  ///< called on connection; empty for a null in stub.cfg
  std::string data_function;        ///< called for data or a ready event; empty for a null in stub.cfg
};

/// An object's gates and entry points.
struct StubConfiguration {
  std::string object_name;
  std::vector<StubService> subjects;
  std::vector<StubService> observers;
  std::vector<std::string> extra_functions;
};

/// Reads a stub.cfg (OPEN-R SDK Programmer's Guide, 2.3) with one setting per line. Other lines are comments. The first
/// word of a service is usually the object's name, but need not be.
/// @param file the file's name, for errors
/// @throw ConfigurationError a setting is malformed, NumOfOSubject or NumOfOObserver is 0 or the wrong number, or two
///   services or extra functions have the same name
StubConfiguration readStub(std::istream& text, const std::string& file);

/// def.h: numOfSubject, numOfObserver, and the indices sbjNAME and obsNAME, like the SDK's stubgen2.
std::string writeDef(const StubConfiguration& stub);

/// entry.h: Entry_Notify, with a selector for each obsNAME, and the indices entryNAME into Extra_Entry, like the SDK's
/// stubgen2.
std::string writeEntry(const StubConfiguration& stub);

/// OBJECTNAME_stub.h, which declares describeOBJECTNAME() for MachineOptions::catalog.
std::string writeDescriptionHeader(const StubConfiguration& stub);

/// OBJECTNAME_stub.cc, which defines describeOBJECTNAME(), and with OPENR_OBJECT_LIBRARY the function that loadObject()
/// calls. It needs the class OBJECTNAME in OBJECTNAME.h.
/// @param priority from the object's .ocf, 0..255
std::string writeDescription(const StubConfiguration& stub, int priority);

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_STUB_GENERATOR_STUB_H
