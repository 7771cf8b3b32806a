/// @file connection.h
/// What one connection to a server is made of, whichever version of the protocol the server speaks.
#ifndef AIBO_DRIVER_CLIENT_CONNECTION_H
#define AIBO_DRIVER_CLIENT_CONNECTION_H

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

#include "aibo_driver/robot_info.h"
#include "client/call.h"
#include "client/color_intake.h"
#include "client/command_outbox.h"
#include "client/counters.h"
#include "client/notifier.h"
#include "client/picture_intake.h"
#include "client/telemetry_intake.h"

namespace aibo_driver {

/// Counts requests that the robot refused although no call waits for them, and logs each refusal once.
class RefusalLog {
 public:
  explicit RefusalLog(const ConnectionContext& context) : context_(context) {}

  /// @param letter of the request
  /// @param problem what was refused and why, in words that follow "refused "
  void refused(char letter, const std::string& problem);

  /// The robot accepted such a request: its next refusal is logged again.
  void accepted(char letter) { last_problems_.erase(letter); }

 private:
  const ConnectionContext& context_;
  std::map<char, std::string> last_problems_;  // by the request's letter
};

/// The state of one connection, from its beginning to its end. It belongs to the client's thread: the loop puts calls
/// and commands in, and the session, which speaks one version of the protocol, takes them out. It does no I/O and reads
/// no clock.
struct Connection {
  using TimePoint = std::chrono::steady_clock::time_point;

  /// @param established when the connection was made
  Connection(const ConnectionContext& the_context, TimePoint established)
      : context(the_context),
        pictures(context, established),
        measurements(context),
        colors(context),
        refusals(context),
        last_joint_turn_(established) {}
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// To be called whenever commands to the joints could be sent, before they are. If that was not possible for long,
  /// because the robot was busy or the link stood still, it drops the commands from before: they are out of date.
  void dropStaleJointCommands(TimePoint now);

  /// Drops the velocity to walk with if it had to wait for long: it is out of date. To be called before it is sent.
  void dropStaleSteering(TimePoint now);

  /// True if this call has to wait until the speed limits have been sent: they hold for the motion that it begins.
  bool mustWaitForSpeedLimits(const Call& call) const {
    return call.takesOverJoints() && !commands.speed_limits.empty();
  }

  /// To be called when a call comes that stops the robot or motions: what came before it and has not been sent must not
  /// move the robot after it.
  void stopComes(const Call& call);

  /// To be called when a call's request, of this many bytes, is sent.
  void callSent(const Call& call, std::size_t size, TimePoint now);

  /// The robot refused a call.
  /// @param why in words, without a full stop
  void refuse(const Call& call, const std::string& why, TimePoint now);

  /// When a picture that is due now is overdue.
  TimePoint pictureDeadline() const;

  /// Says that this server cannot do what is wanted, each time that this changes.
  /// @param format, camera: another resolution or rate than every image at 208x160 is wanted; other camera settings
  ///   than those at the start are
  void warnOfMissingSettings(bool format, bool camera);
  /// The same for colours that are to be detected.
  void warnOfMissingColors(bool wanted);

  /// Says, once, that the pictures come by TCP although UDP is wanted.
  /// @param why in words that follow a colon
  void giveUpDatagrams(const std::string& why);

  /// How long the answer to a request may take.
  std::chrono::milliseconds answerLimit() const;
  /// When the answer to a request that is sent now is overdue.
  TimePoint answerDeadline(TimePoint now) const { return std::max(now, calls.transferEnd()) + answerLimit(); }

  const ConnectionContext context;
  PictureIntake pictures;
  TelemetryIntake measurements;
  ColorIntake colors;
  PendingCalls calls;
  CommandOutbox commands;
  RefusalLog refusals;
  RobotInfo robot;            ///< as the server has introduced itself
  std::string robot_message;  ///< what the robot last reported without being asked and still holds
  PictureTransport transport = PictureTransport::kTcp;  ///< of the stream's pictures
  std::string transport_problem;                        ///< why UDP is not tried any more; empty if it may be
  bool lets_no_datagram_through = false;                ///< that is the problem

 private:
  std::string lackOfRequest() const;

  bool warned_of_format_ = false;
  bool warned_of_camera_ = false;
  bool warned_of_colors_ = false;
  TimePoint last_joint_turn_;  // when commands to the joints could be sent
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_CONNECTION_H
