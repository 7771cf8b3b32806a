#ifndef AIBO_RCSERVER_RCSERVER_REQUESTS_TELEMETRY_REQUESTS_H
#define AIBO_RCSERVER_RCSERVER_REQUESTS_TELEMETRY_REQUESTS_H

#include "rcserver/Interval.h"
#include "rcserver/requests/Exchange.h"
#include "rcserver/requests/Robot.h"

/// Pushes measured values at the client's period.
class TelemetryRequests {
 public:
  TelemetryRequests(const Robot& robot, Exchange& exchange);

  /// Call this for a new client, which gets no telemetry at first.
  void Begin() { interval_ = Interval(); }

  /// Carries out `T`.
  void SetPeriod();

  /// Pushes telemetry if it is due, in place of telemetry that still waits.
  /// @param frame the frame in which all joints were measured
  void Measured(unsigned frame);

 private:
  const Robot& robot_;
  Exchange& exchange_;
  Interval interval_;
  unsigned char content_;  ///< bits of TelemetryContent
};

#endif  // AIBO_RCSERVER_RCSERVER_REQUESTS_TELEMETRY_REQUESTS_H
