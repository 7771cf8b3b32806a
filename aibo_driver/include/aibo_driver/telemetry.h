/// @file telemetry.h
#ifndef AIBO_DRIVER_TELEMETRY_H
#define AIBO_DRIVER_TELEMETRY_H

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

namespace aibo_driver {

/// Where a joint was found.
struct JointReading {
  int id = 0;           ///< RCServer identifier (docs/protocol.md lists them)
  double position = 0;  ///< rad
};

/// What the robot measured at one time. No version of the protocol tells the load of a joint.
struct Telemetry {
  /// OPEN-R frame (8 ms) in which the values were measured. A version 1 server does not tell it.
  std::optional<std::uint32_t> frame_number;
  std::chrono::steady_clock::time_point arrival;  ///< when the first byte was read
  /// From a version 2 server all joints of the robot; from a version 1 server one at a time, in turn.
  std::vector<JointReading> joints;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_TELEMETRY_H
