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

/// What a sensor measured.
struct SensorReading {
  int id = 0;  ///< RCServer identifier (docs/protocol.md lists them)
  /// In SI units: m, m/s^2, degree Celsius; 0..1 for the battery, 0 or 1 for a switch, and for touch the strength as
  /// the robot gives it, 0..80 or so.
  double value = 0;
};

/// What the robot measured at one time. No version of the protocol tells the load of a joint.
struct Telemetry {
  /// OPEN-R frame (8 ms) in which the values were measured. A version 1 server does not tell it.
  std::optional<std::uint32_t> frame_number;
  std::chrono::steady_clock::time_point arrival;  ///< when the first byte was read
  /// From a version 2 server all joints of the robot, and all sensors that have measured something yet; from a version
  /// 1 server one joint or one sensor at a time, in turn.
  std::vector<JointReading> joints;
  std::vector<SensorReading> sensors;
  /// Over which connection it came: 1 for the client's first, 2 for its next. Frame numbers of one connection only grow
  /// (modulo 2^32); from one connection to the next the robot may have been started anew.
  std::uint64_t connection_number = 0;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_TELEMETRY_H
