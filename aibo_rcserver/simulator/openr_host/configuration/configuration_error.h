/// @file configuration_error.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_CONFIGURATION_ERROR_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_CONFIGURATION_ERROR_H

#include <stdexcept>
#include <string>

namespace openr_host {

/// Something is wrong in a configuration file. The text begins with "FILE:LINE: ", as a compiler's does.
class ConfigurationError : public std::runtime_error {
 public:
  ConfigurationError(const std::string& file, int line, const std::string& what)
      : std::runtime_error(file + ":" + std::to_string(line) + ": " + what) {}
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_CONFIGURATION_ERROR_H
