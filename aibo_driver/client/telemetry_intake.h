/// @file telemetry_intake.h
#ifndef AIBO_DRIVER_CLIENT_TELEMETRY_INTAKE_H
#define AIBO_DRIVER_CLIENT_TELEMETRY_INTAKE_H

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "aibo_driver/telemetry.h"
#include "client/possible_values.h"
#include "client/rate_limit.h"

namespace aibo_driver {

struct ConnectionContext;

/// The measurements of one connection. It gives the client's user what is possible, and no more of it than was asked
/// for: the robot is not believed. What is dropped is counted, and logged once for each joint and sensor.
class TelemetryIntake {
 public:
  /// So much telemetry is delivered at once, if more arrived together: two seconds at the highest rate.
  static constexpr std::size_t kMostAtOnce = 64;

  /// @param context must outlive the object
  explicit TelemetryIntake(const ConnectionContext& context) : context_(context) {}

  /// The robot may send telemetry by itself, as in version 2 of the protocol, and from now on was asked for it this
  /// often. In the long run, at most twice as much is delivered.
  /// @param period OPEN-R frames of 8 ms; 0 = not at all
  void askedFor(int period);

  /// @param design of the robot; empty if it is not known
  void deliver(Telemetry telemetry, const std::string& design);

 private:
  /// What a value is of; only to tell values apart.
  enum class Part { kJoint, kSensor, kDuty, kWalk };

  /// Where a joint was last measured.
  struct Place {
    double position;
    std::optional<std::uint32_t> frame_number;
    std::chrono::steady_clock::time_point arrival;
  };

  bool comesTooOften(const Telemetry& telemetry);
  void dropImpossible(Telemetry* telemetry, const std::string& design);
  bool isPossible(const JointReading& joint, const Telemetry& telemetry, const std::string& design);
  bool isPossible(const SensorReading& sensor, const std::string& design);
  bool isPossible(const WalkReading& walk);
  void checkDuty(JointReading* joint, const std::string& design);
  bool complain(Part part, int id, const std::string& problem);

  const ConnectionContext& context_;
  RateLimit limit_{kMostAtOnce};
  std::optional<RateLimit::Duration> shortest_period_;  // empty: the robot is asked for each value
  bool thinning_is_logged_ = false;
  std::map<int, Place> places_;  // by the joint's id
  std::set<std::pair<Part, int>> logged_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_TELEMETRY_INTAKE_H
