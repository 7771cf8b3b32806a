/// @file rcserver_client.h
/// The client of the robot's RCServer. No ROS in it.
#ifndef AIBO_DRIVER_RCSERVER_CLIENT_H
#define AIBO_DRIVER_RCSERVER_CLIENT_H

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "aibo_driver/exceptions.h"
#include "aibo_driver/joints.h"
#include "aibo_driver/leds.h"
#include "aibo_driver/log.h"
#include "aibo_driver/picture.h"
#include "aibo_driver/robot_info.h"
#include "aibo_driver/telemetry.h"

namespace aibo_driver {

class ConnectionLoop;
class TcpTransport;

/// How to reach the robot, and how patient to be with it. Checked by the constructor of RcServerClient.
struct ClientOptions {
  std::string host = "127.0.0.1";  ///< name or address of the robot; not empty
  int port = 54321;                ///< 1..65535; the RCServer's port (report, section 2.2)
  int jpeg_quality = 85;           ///< 1..100, of the stream (report, section 3.3.3, gives 85 as the standard)
  int protocol_version = 0;        ///< 0 = the newest that the server speaks; 1 = version 1 without asking
  std::chrono::milliseconds connect_timeout{2000};     ///< 50 ms..60 s, name lookup included
  std::chrono::milliseconds read_timeout{500};         ///< 50 ms..60 s; a running stream silent for so long is dead
  std::chrono::milliseconds reconnect_wait_min{100};   ///< 10 ms..reconnect_wait_max; doubles with each failure
  std::chrono::milliseconds reconnect_wait_max{2000};  ///< up to 60 s; the longest wait from one attempt to the next
};

enum class ConnectionState { kDisconnected, kConnecting, kConnected };

/// Where the client stands with the robot.
struct ConnectionStatus {
  ConnectionState state = ConnectionState::kDisconnected;
  int protocol_version = 0;            ///< 1 or 2 once connected; 0 while not
  std::string reason;                  ///< why the last connection or attempt ended; empty when all is well
  std::string advice;                  ///< what the user should check; empty when all is well
  FaultKind fault = FaultKind::kNone;  ///< the same as `reason`, for programs; kNone when all is well
  RobotInfo robot;                     ///< who is there, once connected to a version 2 server; else empty
  /// What a version 2 server has last reported by itself, such as a joint that does not move or why it hangs up. Stays
  /// until the next connection; empty if there was nothing.
  std::string robot_message;
};

/// Counters since start(). All of them only ever grow.
struct ClientStatistics {
  std::uint64_t connections = 0;          ///< connections that were established
  std::uint64_t failed_attempts = 0;      ///< attempts that were not
  std::uint64_t stalls = 0;               ///< connections given up because a picture was due and did not come
  std::uint64_t protocol_errors = 0;      ///< connections given up for what the peer sent
  std::uint64_t pictures = 0;             ///< good pictures delivered
  std::uint64_t corrupt_pictures = 0;     ///< pictures dropped: not a whole baseline JPEG of a size the camera has
  std::uint64_t unexpected_pictures = 0;  ///< good pictures dropped: nobody had asked (a stream being stopped)
  std::uint64_t stale_pictures = 0;  ///< good pictures dropped: they had waited unread while this process was held up
  std::uint64_t bytes_received = 0;  ///< bytes read from the socket
  std::uint64_t telemetry = 0;       ///< telemetry delivered
  std::uint64_t refusals = 0;        ///< requests that the robot refused
};

/// Keeps one connection to an RCServer, gets pictures and telemetry over it, moves the joints, and has the robot do all
/// the rest that it can.
///
/// A thread of its own connects, reconnects after every fault with growing, jittered waits, and splits the byte
/// stream into pictures and replies. It asks each server for version 2 of the protocol, and goes on with version 1 if
/// the server refuses or says nothing to that for 500 ms. The wishes to stream and for telemetry survive reconnects; a
/// request for a single picture does not, and a command never does: what moves, shines or is written is done once or
/// not at all. All waiting is done on the steady clock and ends at once when stop() is called.
///
/// Every member function may be called from any thread, except where it says otherwise. All of them are virtual, so
/// that a test can put a fake in the client's place.
class RcServerClient {
 public:
  /// Called on the client's thread with every good picture of the stream, and with those taken by takePicture().
  /// Must not block, and must not call stop() or a function that waits for the robot (those with a timeout): while it
  /// runs, nothing is read from the robot. What it throws is logged.
  using PictureCallback = std::function<void(const PicturePtr& picture)>;
  /// Called on the client's thread each time the connection status changes. Same rules.
  using StatusCallback = std::function<void(const ConnectionStatus& status)>;
  /// Called on the client's thread each time streaming() changes. Same rules.
  using StreamingCallback = std::function<void(bool streaming)>;
  /// Called on the client's thread with what the robot has measured. If several arrived together, only with the newest.
  /// Same rules.
  using TelemetryCallback = std::function<void(const Telemetry& telemetry)>;
  /// Called on the client's thread with where joints were accepted to go, after the robot has clamped it. Same rules.
  using JointsAcceptedCallback = std::function<void(const std::vector<JointTarget>& targets)>;

  struct Callbacks {
    PictureCallback on_picture;
    StatusCallback on_status;
    StreamingCallback on_streaming;
    TelemetryCallback on_telemetry;
    JointsAcceptedCallback on_joints_accepted;
    LogSink log;
  };

  /// Nothing is connected before start().
  /// @throw InvalidArgumentException if an option is out of its range; the message names it and the range.
  RcServerClient(const ClientOptions& options, Callbacks callbacks);

  /// The same over another transport than TCP: for tests.
  RcServerClient(const ClientOptions& options, Callbacks callbacks, std::unique_ptr<TcpTransport> transport);

  /// Calls stop().
  virtual ~RcServerClient();

  RcServerClient(const RcServerClient&) = delete;
  RcServerClient& operator=(const RcServerClient&) = delete;

  /// Begins to connect. Does nothing if it has begun already.
  /// @throw Exception after stop(): a client that was stopped stays stopped
  virtual void start();

  /// Ends the connection and the thread, within a second in every state; a takePicture() in progress ends with
  /// StoppedException. No callback runs after it has returned. Does nothing the second time.
  virtual void stop() noexcept;

  /// What is wanted: pictures all the time, or none. Takes effect at once when connected, otherwise as soon as a
  /// connection stands, and again after each reconnect. Idempotent: wanting what is wanted already sends nothing.
  virtual void setStreaming(bool on);

  /// The quality of the stream's pictures. A running stream of a version 2 server changes at once; that of a version 1
  /// server keeps the quality it was started with until it is next started.
  /// @param quality 1..100
  /// @throw InvalidArgumentException outside of the range
  virtual void setJpegQuality(int quality);

  /// What setJpegQuality() was last told, or the option at first.
  virtual int jpegQuality() const;

  /// True while a stream has been asked for over the present connection and has not been stopped since.
  virtual bool streaming() const;

  /// Waits for a picture that was taken after this call.
  ///
  /// It is one picture of the given quality, taken for this call alone, except during a stream of a version 1 server:
  /// then it is the stream's next picture, at the stream's quality, because such a server must not be sent `F` while it
  /// streams.
  ///
  /// A damaged picture is no answer: it is asked for again, as long as the time allows. If the time passes while a
  /// version 1 server owes a picture, the connection is made anew, since nobody could tell which request its next one
  /// answers.
  ///
  /// @param quality 0..100; 0 = the stream's quality
  /// @param timeout longest time to wait, 1 ms..1 h
  /// @param[out] stream_quality if not null: the quality of the running stream from which the picture was
  /// taken, 1..100;
  ///     0 = it was taken for this call alone
  /// @return the picture, never null
  /// @throw InvalidArgumentException quality or timeout out of range
  /// @throw NetworkException no connection, or it broke while waiting; the message says why and what to check
  /// @throw TimeoutException connected, but no picture came in time
  /// @throw CommandException the robot answered with an error
  /// @throw StoppedException stop() was called
  /// @throw Exception called from a callback
  virtual PicturePtr takePicture(int quality, std::chrono::milliseconds timeout, int* stream_quality = nullptr);

  /// Sends joints to positions: together, in one request, and at once. Returns without waiting for the answer, which
  /// comes through on_joints_accepted, or through the log if the robot refuses.
  ///
  /// A command is carried out once or not at all: nothing is kept while there is no connection, and what a connection
  /// that breaks has not carried out is dropped. If commands come faster than the robot answers, each joint goes to its
  /// latest target, and older ones that have not been sent are dropped.
  ///
  /// A version 1 server is told joint after joint, waiting for the answer to each, and without the duration, which
  /// such a server does not know: the joints move as fast as their speed limits allow.
  ///
  /// @param targets 1..32 joints, each once
  /// @param duration 0..65535 ms; all joints arrive after it; 0 = each as fast as its limits allow
  /// @throw InvalidArgumentException an id, a position, their number or the duration is out of range
  /// @throw NetworkException not connected; the message says why and what to check
  /// @throw CommandException the server says that it has no joints to command
  /// @throw StoppedException stop() was called
  virtual void commandJoints(const std::vector<JointTarget>& targets, std::chrono::milliseconds duration);

  /// Sets how fast joints may move. Sent before later commands to the joints, under the same rules: after a reconnect
  /// it is not set again.
  /// @param limits 1..32 joints, each once
  /// @throw as commandJoints()
  virtual void setJointSpeedLimits(const std::vector<JointSpeedLimit>& limits);

  /// Switches the gains of all joints on or off: off, the joints can be moved by hand.
  /// @param timeout longest time to wait, 1 ms..1 h
  /// @return what the robot says is now the case
  /// @throw InvalidArgumentException timeout out of range
  /// @throw NetworkException no connection, or it broke while waiting
  /// @throw TimeoutException connected, but no answer came in time
  /// @throw CommandException the robot refused, or its server cannot do it: no version 1 server can
  /// @throw StoppedException stop() was called
  /// @throw Exception called from a callback
  virtual bool setMotors(bool on, std::chrono::milliseconds timeout);

  /// Lets LEDs shine. Returns without waiting, under the same rules as commandJoints(): if commands come faster than
  /// the robot answers, each LED gets its latest one.
  ///
  /// A version 1 server is told LED after LED, and their intensity alone: only for all LEDs at once it can be told the
  /// mode. So it is told that if a command gives all 26 LEDs of an ERS-7 the same intensity and mode.
  ///
  /// @param leds 1..32 LEDs, each once
  /// @throw InvalidArgumentException an id, an intensity or their number is out of range
  /// @throw NetworkException not connected; the message says why and what to check
  /// @throw CommandException the server says that it has no LEDs
  /// @throw StoppedException stop() was called
  virtual void commandLeds(const std::vector<LedCommand>& leds);

  /// Flicks the ears: one that is drawn is let go again by the robot after 128 ms, because its magnet must not be held
  /// energised. Returns without waiting, as commandLeds().
  /// @param left true = draw it, false = let it go at once
  /// @param right the same
  /// @throw NetworkException, CommandException, StoppedException as commandLeds()
  virtual void commandEars(bool left, bool right);

  /// Plays a motion from the robot's memory stick (MTN, Sony's format). Returns when the robot has begun. Motions that
  /// move different joints play at the same time.
  ///
  /// This and the functions up to rebootRobot() work alike: each asks the robot once, and waits. If a version 1 server
  /// has been asked and the time passes, the connection is made anew, since nobody could tell what its next answer is
  /// about. All of them
  /// @throw InvalidArgumentException an argument is out of range, or `name` is no name of a motion
  /// @throw NetworkException no connection, or it broke while waiting: the robot may or may not have done it
  /// @throw TimeoutException connected, but no answer came in time
  /// @throw CommandException the robot refused, or its server cannot do it; the message says why, and what to do
  /// @throw StoppedException stop() was called
  /// @throw Exception called from a callback
  ///
  /// @param name of the file, such as NOD.MTN: 8 characters at most, then .MTN; large and small letters are the same
  /// @param repetitions 1..65535
  /// @param timeout longest time to wait, 1 ms..1 h
  virtual void playMotion(const std::string& name, int repetitions, std::chrono::milliseconds timeout);

  /// Stops a motion: its joints hold where they are.
  /// @param name of the motion; empty = all that are playing
  virtual void stopMotion(const std::string& name, std::chrono::milliseconds timeout);

  /// Writes a motion to the robot's memory stick, in the place of one of this name. The robot's RCSERVER.CFG has to
  /// allow it (ALLOW_UPLOAD). Pictures go on meanwhile; a version 1 server is asked for nothing else until it is done.
  /// @param content the file's bytes, 1..65523: what a request of version 2 holds beside a name. This project's
  /// RCServer
  ///   takes no motion of more than 64000.
  virtual void uploadMotion(const std::string& name, const std::vector<std::uint8_t>& content,
                            std::chrono::milliseconds timeout);

  /// Deletes a motion from the robot's memory stick. RCSERVER.CFG has to allow it (ALLOW_DELETE).
  virtual void deleteMotion(const std::string& name, std::chrono::milliseconds timeout);

  /// The names of the motions on the robot's memory stick. No version 1 server tells them.
  virtual std::vector<std::string> listMotions(std::chrono::milliseconds timeout);

  /// Switches the motors off, so that the robot sinks down, and then the robot. RCSERVER.CFG has to allow it
  /// (ALLOW_SHUT_DOWN). The connection ends after the answer; this client goes on trying to connect.
  virtual void shutDownRobot(std::chrono::milliseconds timeout);

  /// The same, and the robot starts anew (ALLOW_REBOOT).
  virtual void rebootRobot(std::chrono::milliseconds timeout);

  /// What is wanted: telemetry each so many OPEN-R frames of 8 ms, or none. Takes effect as setStreaming() does.
  ///
  /// A version 1 server sends no telemetry. While some is wanted it is asked for joints and sensors in turn, 20 of each
  /// a second whatever the period, so that the answers cost the stream of pictures next to nothing. Such a server does
  /// not say which robot it is on: its sensors are taken for those of an ERS-7.
  ///
  /// @param frames 0..65535; 0 = none; 4 (32 ms) is as often as the robot measures
  /// @throw InvalidArgumentException outside of the range
  virtual void setTelemetryPeriod(int frames);

  /// A snapshot of the connection's status.
  virtual ConnectionStatus status() const;

  /// A snapshot of the counters.
  virtual ClientStatistics statistics() const;

 private:
  std::unique_ptr<ConnectionLoop> loop_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_RCSERVER_CLIENT_H
