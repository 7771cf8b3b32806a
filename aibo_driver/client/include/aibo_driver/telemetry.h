/// @file telemetry.h
#ifndef AIBO_DRIVER_TELEMETRY_H
#define AIBO_DRIVER_TELEMETRY_H

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "aibo_driver/walk.h"

namespace aibo_driver {

/// The position of a joint, and how hard its motor works.
struct JointReading {
  int id = 0;           ///< RCServer identifier (docs/protocol.md lists them)
  double position = 0;  ///< rad
  /// The motor's share of full power: 1 is full power forward, -1 full power backward. Empty if the server does not
  /// send it.
  std::optional<double> duty = std::nullopt;
};

/// The value of a sensor.
struct SensorReading {
  int id = 0;  ///< RCServer identifier (docs/protocol.md lists them)
  /// In m, m/s^2 or degree Celsius; 0..1 for the battery; 0 or 1 for a switch; for touch, the strength as the robot
  /// reports it, 0 to about 80.
  double value = 0;
};

/// What the robot measured at one time.
struct Telemetry {
  /// OPEN-R frame (8 ms) in which the values were measured. A version 1 server does not send it.
  std::optional<std::uint32_t> frame_number;
  std::chrono::steady_clock::time_point arrival;  ///< when the first byte was read
  /// From a version 2 server: all joints of the robot, and all sensors that have measured something so far. From a
  /// version 1 server: one joint or one sensor at a time, in turn.
  std::vector<JointReading> joints;
  std::vector<SensorReading> sensors;
  std::optional<WalkReading> walk;  ///< only from a server that can walk (request `S`)
  /// Of the connection it came over: 1 for the client's first, 2 for its next. Frame numbers of one connection only
  /// grow (modulo 2^32); between two connections the robot may have been restarted.
  std::uint64_t connection_number = 0;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_TELEMETRY_H
