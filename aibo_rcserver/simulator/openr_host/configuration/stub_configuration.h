/// @file stub_configuration.h
/// stub.cfg: what an object's gates and entry points are called.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_STUB_CONFIGURATION_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_STUB_CONFIGURATION_H

#include <istream>
#include <string>
#include <vector>

#include "simulator/openr_host/configuration/service_name.h"

namespace openr_host {

/// A line that begins with Service.
struct StubService {
  ServiceName name;
  std::string connection_function;  ///< called when the service is connected; empty for null
  std::string data_function;        ///< called for a message or a ready event; empty for null
};

struct StubConfiguration {
  std::string object_name;
  std::vector<StubService> subjects;
  std::vector<StubService> observers;
  std::vector<std::string> extra_functions;

  /// Reads the text of a stub.cfg (OPEN-R SDK Programmer's Guide, 2.3): one setting a line. A line that sets nothing,
  /// such as a comment, is skipped. A service's first word is usually the object's name, but may be any.
  /// @param file its name, for errors
  /// @throw ConfigurationError if a setting is malformed, if NumOfOSubject or NumOfOObserver is 0 or is not the number
  /// of such services, or if two services or extra functions have one name
  static StubConfiguration parse(std::istream& text, const std::string& file);
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_STUB_CONFIGURATION_H
