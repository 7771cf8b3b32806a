/// @file Version2Telemetry.h
/// What the robot measures, for a client of version 2.
#ifndef AIBO_RCSERVER_RCSERVER_VERSION2_VERSION2_TELEMETRY_H
#define AIBO_RCSERVER_RCSERVER_VERSION2_VERSION2_TELEMETRY_H

#include "rcserver/body/Sensors.h"
#include "rcserver/joints/JointControl.h"
#include "rcserver/version2/Version2Replies.h"

/// Carries out `T`, and pushes what is measured as often as was asked for. Pure logic: no OPEN-R.
class Version2Telemetry {
 public:
  typedef Version2Replies::Request Request;

  /// All must outlive this.
  Version2Telemetry(const JointControl& joints, const Sensors& sensors, Version2Replies& replies);

  /// A new client: nothing is pushed.
  void Begin();

  /// @param payload as many bytes as the request's header says
  void SetPeriod(const Request& request, const unsigned char* payload);

  /// Pushes telemetry if it is due.
  /// @param frame in which everything was measured
  void Measured(unsigned frame);

 private:
  void Push(unsigned frame);

  const JointControl& joints_;
  const Sensors& sensors_;
  Version2Replies& replies_;
  unsigned short period_;  ///< in frames; 0: none
  bool has_pushed_;        ///< since the period was set
  unsigned last_;          ///< frame in which telemetry was pushed
};

#endif  // AIBO_RCSERVER_RCSERVER_VERSION2_VERSION2_TELEMETRY_H
