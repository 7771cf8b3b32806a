/// @file connection.h
/// The parts of one connection to a server. They are the same for every version of the protocol.
#ifndef AIBO_DRIVER_CLIENT_CONNECTION_H
#define AIBO_DRIVER_CLIENT_CONNECTION_H

#include <algorithm>
#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "aibo_client/status.h"
#include "aibo_client/walk.h"
#include "client/call.h"
#include "client/color_intake.h"
#include "client/command_outbox.h"
#include "client/notifier.h"
#include "client/picture_intake.h"
#include "client/sound_intake.h"
#include "client/telemetry_intake.h"

namespace aibo_client {

/// The state of one connection, from its beginning to its end. It belongs to the client's thread. The loop puts calls
/// and commands in. The session, which speaks one version of the protocol, takes them out. It does no I/O and reads no
/// clock.
struct Connection {
  using TimePoint = std::chrono::steady_clock::time_point;

  /// @param established when the connection was made
  Connection(const ConnectionContext& the_context, TimePoint established);
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Drops the unsent orders that are too old. Call this before an order is sent.
  void dropTooOld(TimePoint now);

  /// Limits speeds of joints, unless this connection has sent the same limits or will send them anyway.
  void limitSpeeds(std::vector<JointSpeedLimit> limits);

  /// Call this when the robot has refused limits of these joints' speeds. The same limits will be sent when they are
  /// commanded again.
  void forgetSpeedLimits(const std::vector<int>& joints);

  /// Reports that the robot has refused a request for which no call waits.
  void refused(const Refusal& refusal);
  /// Logs such a refusal if RefusedRequest does not have its kind.
  /// @param problem what was refused and why, in words that follow "refused "
  void refused(const std::string& problem);

  /// True if this call begins a motion that must wait until its speed limits have been sent.
  bool mustWaitForSpeedLimits(const Call& call) const {
    return call.has(protocol::version2::TAKES_OVER_JOINTS) && !commands.speed_limits.empty();
  }

  /// Adds a call. If it stops the robot or takes over joints, older orders that have not been sent are dropped, so that
  /// they do not move the robot after it.
  void add(Call call);

  /// Ends the calls whose deadline has passed. An order that has not been sent is withdrawn.
  void expireCalls(TimePoint now);

  /// Call this when a call's request, which has this many bytes, is sent.
  void callSent(const Call& call, std::size_t size, TimePoint now);

  /// Ends a call that the robot refused.
  /// @param why the reason in words, without a full stop
  void refuse(const Call& call, RefusalCause cause, const std::string& why, TimePoint now);

  /// When a picture that is due now will be overdue.
  TimePoint pictureDeadline() const;

  /// Logs that the pictures come by TCP although UDP is wanted.
  /// @param why the reason in words that follow a colon
  void giveUpDatagrams(const std::string& why);

  /// How long the answer to a request may take.
  std::chrono::milliseconds answerLimit() const;
  /// When the answer to a request that is sent now will be overdue.
  TimePoint answerDeadline(TimePoint now) const { return std::max(now, calls.transferEnd()) + answerLimit(); }

  const ConnectionContext context;
  PictureIntake pictures;
  TelemetryIntake measurements;
  ColorIntake colors;
  SoundIntake sound;
  PendingCalls calls;
  CommandOutbox commands;
  ConnectionStatus status;              ///< published when the session is ready, and at its end
  std::string goes_off;                 ///< why the robot goes off, if it has said that it does
  MotorsAndPosture motors_and_posture;  ///< the last report of the robot

 private:
  void tell(const Refusal& refusal);
  void tellRefused(const Call& call, RefusalCause cause, const std::string& reason);

  std::map<int, double> speed_limits_;  // rad/s, by the joint's id
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_CONNECTION_H
