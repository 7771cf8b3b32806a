#ifndef AIBO_RCSERVER_RCSERVER_REQUESTS_TELEMETRY_REQUESTS_H
#define AIBO_RCSERVER_RCSERVER_REQUESTS_TELEMETRY_REQUESTS_H

#include "rcserver/requests/Exchange.h"
#include "rcserver/requests/Robot.h"

/// Pushes measured values at the client's period.
class TelemetryRequests {
 public:
  TelemetryRequests(const Robot& robot, Exchange& exchange);

  /// Call this for a new client, which gets no telemetry at first.
  void Begin() { wish_ = Wish(); }

  /// Carries out `T`.
  void SetPeriod();

  /// Pushes telemetry if it is due, in place of telemetry that still waits.
  /// @param frame the frame in which all joints were measured
  void Measured(unsigned frame);

 private:
  // What the client wants. Everything is 0 for a new client.
  struct Wish {
    unsigned short period;  ///< in frames; 0: no telemetry
    unsigned char content;  ///< bits of TelemetryContent
    bool has_pushed;        ///< telemetry was pushed since the period was set
    unsigned last;          ///< frame in which telemetry was last pushed
  };

  const Robot& robot_;
  Exchange& exchange_;
  Wish wish_;
};

#endif  // AIBO_RCSERVER_RCSERVER_REQUESTS_TELEMETRY_REQUESTS_H
