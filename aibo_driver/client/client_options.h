/// @file client_options.h
#ifndef AIBO_DRIVER_CLIENT_CLIENT_OPTIONS_H
#define AIBO_DRIVER_CLIENT_CLIENT_OPTIONS_H

#include <string>

#include "aibo_driver/rcserver_client.h"

namespace aibo_driver {

/// @throw InvalidArgumentException if an option is out of its range; the message names the option and the range
void checkClientOptions(const ClientOptions& options);

/// @throw InvalidArgumentException if the value is outside of lowest..highest; the message says so
void checkRange(const std::string& name, long long value, long long lowest, long long highest, const char* unit = "");

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_CLIENT_OPTIONS_H
