/// @file connection.h
/// What one connection to a server is made of, whichever version of the protocol the server speaks.
#ifndef AIBO_DRIVER_CLIENT_CONNECTION_H
#define AIBO_DRIVER_CLIENT_CONNECTION_H

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <string>

#include "aibo_driver/motors_and_posture.h"
#include "aibo_driver/robot_info.h"
#include "client/call.h"
#include "client/color_intake.h"
#include "client/command_outbox.h"
#include "client/counters.h"
#include "client/notifier.h"
#include "client/picture_intake.h"
#include "client/telemetry_intake.h"

namespace aibo_driver {

/// Tells of requests that the robot refused although no call waits for them: the client's user, or the log, once for
/// each problem.
class RefusalLog {
 public:
  explicit RefusalLog(const ConnectionContext& context) : context_(context) {}

  /// @param letter of the request
  /// @param problem what was refused and why, in words that follow "refused "
  void refused(char letter, const std::string& problem);

  /// The same for an order, whose user can be told.
  /// @param problem as above, without the reason, which follows
  void refused(char letter, const std::string& problem, const Refusal& refusal);

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
        refusals(context) {}
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Drops orders that have waited for too long. To be called before one is sent, and at nextTooOld() at the latest.
  void dropTooOld(TimePoint now);

  /// When an order becomes too old.
  TimePoint nextTooOld() const { return std::min(commands.nextTooOld(), calls.nextTooOld()); }

  /// Tells of the orders that were dropped.
  void reportDropped();

  /// True if this call has to wait until the speed limits have been sent: they hold for the motion that it begins.
  bool mustWaitForSpeedLimits(const Call& call) const {
    return call.takesOverJoints() && !commands.speed_limits.empty();
  }

  /// Adds a call. What came before it and has not been sent must not move the robot after it, if it stops the robot or
  /// takes over joints.
  void add(Call call);

  /// Ends the call whose request was sent with this number, if there is one.
  void answer(int request_number, Answer answer);

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
  RobotInfo robot;                      ///< as the server has introduced itself
  std::string robot_message;            ///< what the robot last reported without being asked and still holds
  MotorsAndPosture motors_and_posture;  ///< as the robot last said
  PictureTransport transport = PictureTransport::kTcp;  ///< of the stream's pictures
  std::string transport_problem;                        ///< why UDP is not tried any more; empty if it may be
  bool lets_no_datagram_through = false;                ///< that is the problem

 private:
  std::string lackOfRequest() const;

  bool warned_of_format_ = false;
  bool warned_of_camera_ = false;
  bool warned_of_colors_ = false;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_CONNECTION_H
