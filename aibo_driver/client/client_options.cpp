#include "client/client_options.h"

#include <string>

#include "aibo_driver/exceptions.h"

namespace aibo_driver {

void checkRange(const std::string& name, long long value, long long lowest, long long highest, const char* unit) {
  if (value < lowest || value > highest) {
    throw InvalidArgumentException(name + " is " + std::to_string(value) + unit + ", but has to be " +
                                   std::to_string(lowest) + ".." + std::to_string(highest) + unit);
  }
}

void checkClientOptions(const ClientOptions& options) {
  if (options.host.empty()) {
    throw InvalidArgumentException("host is empty, but has to be the robot's name or address");
  }
  constexpr long long kMinute = 60000;  // ms
  checkRange("port", options.port, 1, 65535);
  checkRange("jpeg_quality", options.jpeg_quality, 1, 100);
  checkRange("protocol_version", options.protocol_version, 0, 1);
  checkRange("connect_timeout", options.connect_timeout.count(), 50, kMinute, " ms");
  checkRange("read_timeout", options.read_timeout.count(), 50, kMinute, " ms");
  checkRange("reconnect_wait_max", options.reconnect_wait_max.count(), 10, kMinute, " ms");
  checkRange("reconnect_wait_min", options.reconnect_wait_min.count(), 10, options.reconnect_wait_max.count(), " ms");
}

}  // namespace aibo_driver
