/// @file telemetry.h
#ifndef AIBO_CLIENT_TELEMETRY_H
#define AIBO_CLIENT_TELEMETRY_H

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "aibo_client/walk.h"

namespace aibo_client {

/// The position of a joint, and how hard its motor works.
struct JointReading {
  int id = 0;           ///< RCServer identifier (names.h)
  double position = 0;  ///< rad
  /// The motor's share of full power: 1 is full power forward, -1 is full power backward. It is empty if the server
  /// does not send it.
  std::optional<double> duty = std::nullopt;
};

/// The value of a sensor.
struct SensorReading {
  int id = 0;  ///< RCServer identifier (names.h)
  /// The value in m, m/s^2 or degrees Celsius. It is 0..1 for the battery and 0 or 1 for a switch. For touch it is the
  /// strength that the robot reports, 0 to about 80.
  double value = 0;
};

/// The robot's measurements at one time.
struct Telemetry {
  /// The OPEN-R frame (8 ms) in which the values were measured. A version 1 server does not send it.
  std::optional<std::uint32_t> frame_number;
  std::chrono::steady_clock::time_point arrival;  ///< when the first byte was read
  /// A version 2 server sends all joints of the robot, and all sensors that have measured something so far. A version 1
  /// server sends one joint or one sensor at a time, in turn.
  std::vector<JointReading> joints;
  std::vector<SensorReading> sensors;
  std::optional<WalkReading> walk;  ///< only from a server that can walk (request `S`)
  /// The number of the connection: the client's first one is 1, its next one 2. In one connection, frame numbers only
  /// grow (modulo 2^32). Between two connections the robot may have been restarted.
  std::uint64_t connection_number = 0;
};

/// The time between two measurements over the same connection. It is measured by the robot's clock or, if one
/// measurement has no frame number, by the times of arrival. Frame numbers may wrap around.
/// @return seconds
inline double secondsBetween(const std::optional<std::uint32_t>& earlier_frame,
                             std::chrono::steady_clock::time_point earlier_arrival, const Telemetry& later) {
  constexpr double kFrame = 0.008;  // s, an OPEN-R frame
  return later.frame_number && earlier_frame ? kFrame * static_cast<std::uint32_t>(*later.frame_number - *earlier_frame)
                                             : std::chrono::duration<double>(later.arrival - earlier_arrival).count();
}

}  // namespace aibo_client

#endif  // AIBO_CLIENT_TELEMETRY_H
