/// @file connection_configuration.h
/// CONNECT.CFG: which gate of which object leads to which.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_CONNECTION_CONFIGURATION_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_CONNECTION_CONFIGURATION_H

#include <istream>
#include <string>
#include <vector>

#include "simulator/openr_host/configuration/service_name.h"

namespace openr_host {

/// One connection: a subject's service and an observer's.
struct ServiceConnection {
  ServiceName subject;
  ServiceName observer;
  int line;  ///< of the subject
};

/// Reads the text of a CONNECT.CFG: subject, white space, observer; with comments and models as in OBJECT.CFG.
/// @param file its name, for errors
/// @param design the robot's model
/// @param services all services that the objects of this stick have
/// @throw ConfigurationError if something else stands there, if no object has the service, if the data types differ,
/// or if a connection stands there twice
std::vector<ServiceConnection> readConnectionConfiguration(std::istream& text, const std::string& file,
                                                           const std::string& design,
                                                           const std::vector<std::string>& services);

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_CONNECTION_CONFIGURATION_H
