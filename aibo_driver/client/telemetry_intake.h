/// @file telemetry_intake.h
#ifndef AIBO_DRIVER_CLIENT_TELEMETRY_INTAKE_H
#define AIBO_DRIVER_CLIENT_TELEMETRY_INTAKE_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "aibo_client/telemetry.h"
#include "client/notifier.h"
#include "system/rate_limit.h"

namespace aibo_client {

/// Checks and delivers the measurements of one connection. It does not trust the robot: it delivers only what is
/// possible, and no more than was asked for. What it drops is counted, and logged once for each joint and sensor.
class TelemetryIntake {
 public:
  /// The most telemetry that is delivered at once, if more has arrived together: 5 s at the highest rate. A robot
  /// disconnects a client that has read nothing for longer.
  static constexpr std::size_t kMostAtOnce = 160;

  /// @param context must outlive the object
  explicit TelemetryIntake(const ConnectionContext& context) : context_(context) {}

  /// Call this with each request if the robot sends telemetry by itself, as in version 2 of the protocol. In the long
  /// run, at most twice as much as requested is delivered.
  /// @param period OPEN-R frames of 8 ms; 0 means no telemetry
  void askedFor(int period);

  /// @param design the robot's design; empty if it is not known
  void deliver(Telemetry telemetry, const std::string& design);

 private:
  bool comesTooOften(const Telemetry& telemetry);
  void dropImpossible(Telemetry* telemetry, const std::string& design);
  template <typename Range, typename Name>
  bool isPossible(double value, const Range& range, const Name& name);
  void complain(const std::string& name, const std::string& problem);

  const ConnectionContext& context_;
  aibo_system::RateLimit limit_{kMostAtOnce};
  std::optional<aibo_system::RateLimit::Duration> shortest_period_;  // empty if the robot is asked for each value
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_TELEMETRY_INTAKE_H
