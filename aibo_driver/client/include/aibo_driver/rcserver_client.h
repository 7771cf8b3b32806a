/// @file rcserver_client.h
/// The client of the robot's RCServer. It does not depend on ROS.
#ifndef AIBO_DRIVER_RCSERVER_CLIENT_H
#define AIBO_DRIVER_RCSERVER_CLIENT_H

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "aibo_driver/camera.h"
#include "aibo_driver/colors.h"
#include "aibo_driver/exceptions.h"
#include "aibo_driver/joints.h"
#include "aibo_driver/leds.h"
#include "aibo_driver/log.h"
#include "aibo_driver/motion_end.h"
#include "aibo_driver/motors_and_posture.h"
#include "aibo_driver/orders.h"
#include "aibo_driver/picture.h"
#include "aibo_driver/robot_info.h"
#include "aibo_driver/telemetry.h"
#include "aibo_driver/walk.h"

namespace aibo_driver {

class ConnectionLoop;
class TcpTransport;

/// How to reach the robot, and how long to wait for it. The constructor of RcServerClient checks every option.
struct ClientOptions {
  std::string host = "127.0.0.1";  ///< name or address of the robot; not empty
  int port = 54321;                ///< 1..65535; the RCServer's port (report, section 2.2)
  int jpeg_quality = 85;           ///< 1..100, of the stream (report, section 3.3.3, gives 85 as the standard)
  int protocol_version = 0;        ///< 0 = the newest that the server speaks; 1 = version 1, without asking
  PictureTransport picture_transport = PictureTransport::kTcp;  ///< as for setPictureTransport()
  std::chrono::milliseconds connect_timeout{2000};              ///< 50 ms..60 s, name lookup included
  std::chrono::milliseconds read_timeout{500};         ///< 50 ms..60 s; a stream that is silent for longer is dead
  std::chrono::milliseconds reconnect_wait_min{100};   ///< 10 ms..reconnect_wait_max; the wait doubles at each failure
  std::chrono::milliseconds reconnect_wait_max{2000};  ///< 10 ms..60 s; the longest wait from one attempt to the next
  /// The robot plays and stores motions for other robots, too, without the joints that it does not have. Otherwise it
  /// refuses them. Version 1 servers always refuse.
  bool leave_out_missing_joints = false;
};

enum class ConnectionState {
  kDisconnected,
  kConnecting,  ///< also while a connection stands over which the robot has not answered yet
  kConnected
};

/// The state of the connection to the robot.
struct ConnectionStatus {
  ConnectionState state = ConnectionState::kDisconnected;
  int protocol_version = 0;            ///< 1 or 2 once connected; 0 while not
  std::string reason;                  ///< why the last connection or attempt ended; empty when all is well
  std::string advice;                  ///< what the user should check; empty when all is well
  FaultKind fault = FaultKind::kNone;  ///< the same as `reason`, for programs; kNone when all is well
  RobotInfo robot;                     ///< from the server, once connected to one of version 2; else empty
  /// The last report of a version 2 server that answers no request, such as a joint that does not move, or why the
  /// server hangs up. It is kept until the next connection; that of a joint is over when the server says that the joint
  /// follows its commands again, and then the last report before it that still holds is here. Empty if there is none.
  std::string robot_message;
  PictureTransport transport = PictureTransport::kTcp;  ///< by which the pictures of the stream come now
  std::string transport_problem;  ///< why they come by TCP although UDP is wanted, in words; empty if all is well
};

/// Counters since start(). They never decrease.
struct ClientStatistics {
  std::uint64_t connections = 0;       ///< connections that were established
  std::uint64_t failed_attempts = 0;   ///< attempts to connect that failed
  std::uint64_t stalls = 0;            ///< connections given up because a picture or an answer was due and did not come
  std::uint64_t protocol_errors = 0;   ///< connections given up because the peer broke the protocol
  std::uint64_t pictures = 0;          ///< good pictures delivered
  std::uint64_t corrupt_pictures = 0;  ///< pictures dropped: not a whole baseline JPEG of a size the camera has
  std::uint64_t unexpected_pictures = 0;  ///< good pictures dropped: the stream is off (it was just stopped)
  std::uint64_t stale_pictures = 0;       ///< good pictures dropped: this process was held up, and they waited unread
  std::uint64_t bytes_received = 0;       ///< bytes read from the socket
  std::uint64_t telemetry = 0;            ///< telemetry delivered
  std::uint64_t dropped_telemetry = 0;  ///< telemetry dropped: this process was held up, and more than 64 waited unread
  std::uint64_t thinned_telemetry = 0;  ///< telemetry dropped: it came more than twice as often as it was asked for
  std::uint64_t thinned_colors = 0;     ///< detected colours dropped: they came more than twice as often as asked for
  std::uint64_t impossible_values = 0;  ///< values dropped from telemetry or detected colours: no robot can have them
  std::uint64_t refusals = 0;           ///< requests that the robot refused

  /// @name Pictures by UDP
  /// @{
  std::uint64_t datagrams = 0;            ///< received from the robot
  std::uint64_t lost_datagrams = 0;       ///< that have not come; counted when 64 later ones have been sent
  std::uint64_t reordered_datagrams = 0;  ///< that came behind later ones
  std::uint64_t duplicate_datagrams = 0;  ///< that came before
  std::uint64_t bad_datagrams = 0;        ///< dropped: from the robot's address, but no part of a picture
  std::uint64_t foreign_datagrams = 0;    ///< dropped: not from the robot's address
  std::uint64_t repaired_datagrams = 0;   ///< lost or late, and made from others that came
  std::uint64_t lost_pictures = 0;        ///< of which a datagram was lost, or came too late
  /// @}
};

/// Keeps one connection to an RCServer: gets pictures and telemetry over it, moves the joints, and gives the robot
/// every other order that its server knows.
///
/// A thread of its own connects, splits the byte stream into pictures and replies, and reconnects after every fault,
/// with growing, jittered waits. It asks each server for version 2 of the protocol, and falls back to version 1 if the
/// server refuses or does not answer within 500 ms. In the latter case it is asked for a picture, which is dropped,
/// unless the stream is wanted: only a server that answers is connected to. After a reconnect, the stream and telemetry
/// are requested again if they are still wanted. A single picture is not requested again, and no command is ever
/// repeated: the robot carries it out once or not at all. All waiting uses the steady clock and ends at once when
/// stop() is called.
///
/// Every member function may be called from any thread, except where its comment says otherwise. All of them are
/// virtual, so that a test can replace the client with a fake.
class RcServerClient {
 public:
  /// Called on the client's thread with every good picture, of the stream or taken by takePicture(), except one of
  /// takePicture() that has another resolution than the running stream. It must not block,
  /// and must not call stop() or a function that waits for the robot (those with a timeout): while it runs, nothing is
  /// read from the robot. An exception that it throws is logged.
  using PictureCallback = std::function<void(const PicturePtr& picture)>;
  /// Called on the client's thread each time status() changes. Same rules.
  using StatusCallback = std::function<void(const ConnectionStatus& status)>;
  /// Called on the client's thread each time streaming() changes. Same rules.
  using StreamingCallback = std::function<void(bool streaming)>;
  /// Called on the client's thread with measurements of the robot, in order. If several arrived together, such as after
  /// the radio was held up, it is called for each: for the newest 64, if there are more. What comes more than twice as
  /// often as it was asked for is dropped, and so are values that no joint or sensor of this robot can have. Same
  /// rules.
  using TelemetryCallback = std::function<void(const Telemetry& telemetry)>;
  /// Called on the client's thread with the targets that the robot accepted for joints, clamped to their limits. Same
  /// rules.
  using JointsAcceptedCallback = std::function<void(const std::vector<JointTarget>& targets)>;
  /// Called on the client's thread with LEDs as the robot accepted them, each once: an LED that is only on or off has
  /// intensity 0 or 255 if the server says so, which one of version 1 does not always. Version 1 sets modes for all
  /// LEDs at once; until it has, mode A is assumed. Same rules.
  using LedsAcceptedCallback = std::function<void(const std::vector<LedCommand>& leds)>;
  /// Called on the client's thread with the velocity that the robot accepted for walking, within its limits. Same
  /// rules.
  using SteeredCallback = std::function<void(const WalkVelocity& in_force)>;
  /// Called on the client's thread each time a version 2 server reports that something it did has ended, such as a
  /// motion. A motion, walk or posture that has not ended when the connection breaks is stopped by the robot, without a
  /// report. Same rules.
  using EndedCallback = std::function<void(const MotionEnd& end)>;
  /// Called on the client's thread each time a request that nobody waits for was refused or dropped, and when a joint
  /// does not follow its commands. If it is not set, the refusal is logged. A request that a newer one of the same kind
  /// has replaced before it was sent is no refusal, and when a connection ends, what was not sent is dropped without
  /// one. Same rules.
  using RefusedCallback = std::function<void(const Refusal& refusal)>;
  /// Called on the client's thread when the robot answers a call with an OrderTerms::number other than 0, after that
  /// call has ended with a TimeoutException. It does not come if the connection ends first, which it does with such a
  /// call in version 1. Same rules.
  using LateAnswerCallback = std::function<void(const LateAnswer& answer)>;
  /// Called on the client's thread each time a version 2 server says that the motors or the posture have changed, soon
  /// after the connection is made, and with everything unknown when a connection ends. Same rules.
  using MotorsAndPostureCallback = std::function<void(const MotorsAndPosture& state)>;
  /// Called on the client's thread with what the robot's camera has detected in an image. Of several that arrived
  /// together, only the newest counts. What comes more than twice as often as it was asked for is dropped, and so are
  /// regions that contradict themselves. Same rules.
  using ColorsCallback = std::function<void(const DetectedColors& colors)>;

  /// Any of them may be empty.
  struct Callbacks {
    PictureCallback on_picture;
    StatusCallback on_status;
    StreamingCallback on_streaming;
    TelemetryCallback on_telemetry;
    JointsAcceptedCallback on_joints_accepted;
    LedsAcceptedCallback on_leds_accepted;
    SteeredCallback on_steered;
    EndedCallback on_ended;
    RefusedCallback on_refused;
    LateAnswerCallback on_late_answer;
    MotorsAndPostureCallback on_motors_and_posture;
    ColorsCallback on_colors;
    LogSink log;
  };

  /// Does not connect yet: see start().
  /// @throw InvalidArgumentException an option is out of its range; the message names both
  RcServerClient(const ClientOptions& options, Callbacks callbacks);

  /// The same with a transport of its own, for tests that replace the name lookup.
  RcServerClient(const ClientOptions& options, Callbacks callbacks, std::unique_ptr<TcpTransport> transport);

  /// Calls stop().
  virtual ~RcServerClient();

  RcServerClient(const RcServerClient&) = delete;
  RcServerClient& operator=(const RcServerClient&) = delete;

  /// Begins to connect. Does nothing the second time.
  /// @throw Exception after stop(): a client that was stopped stays stopped
  virtual void start();

  /// Ends the connection and the thread, within a second in every state. Calls in progress end with StoppedException.
  /// No callback runs after it has returned. Does nothing the second time.
  virtual void stop() noexcept;

  /// Switches the stream of pictures on or off. Takes effect at once when connected, otherwise as soon as there is a
  /// connection, and again after each reconnect. Sends nothing if the stream is already as wanted.
  virtual void setStreaming(bool on);

  /// Sets the quality of the stream's pictures. A version 2 server changes a running stream at once; a version 1 server
  /// uses the new quality when the stream is next started.
  /// @param quality 1..100
  /// @throw InvalidArgumentException quality out of range
  virtual void setJpegQuality(int quality);

  /// The quality last set by setJpegQuality(), or at first by ClientOptions::jpeg_quality; 1..100.
  virtual int jpegQuality() const;

  /// Sets the resolution and the rate of the stream. A version 2 server changes a running stream at once. A version 1
  /// server has only pictures of every image in Resolution::kHigh, and a camera may lack the bands for
  /// Resolution::kDouble: then the stream is that of Resolution::kHigh, and the log says so.
  /// @throw InvalidArgumentException every_nth_image out of range
  virtual void setStreamFormat(const StreamFormat& format);

  /// The format last set by setStreamFormat().
  virtual StreamFormat streamFormat() const;

  /// Sets how the pictures of the stream come. Takes effect as setStreaming() does. A server that speaks version 1 or
  /// lacks the capability `B` sends them by TCP, and the log says so.
  ///
  /// A datagram is taken from the robot's address alone. A picture is delivered when all its datagrams have come, and
  /// never after a newer one. If nothing comes by UDP for 1 s although TCP works, or if 20 pictures in a row have lost
  /// a datagram, the pictures come by TCP from then on: see ConnectionStatus::transport_problem. UDP is tried again
  /// over the next connection, unless no datagram has ever come; and when this is set to TCP and then to UDP.
  virtual void setPictureTransport(PictureTransport transport);

  /// Sets the camera. Takes effect as setStreaming() does; the robot resets the camera when the connection ends. What
  /// is in force for a picture is in Picture::settings. A server that speaks version 1 or lacks the capability `G`
  /// cannot set its camera, and a robot may refuse a setting: the log says so.
  /// @throw InvalidArgumentException a setting is out of range
  virtual void setCameraSettings(const CameraSettings& settings);

  /// Switches the detection of colours on or off. Takes effect as setStreaming() does, and does not need the stream. A
  /// server that speaks version 1 or lacks the capability `Z` detects nothing: the log says so, once.
  /// @throw InvalidArgumentException every_nth_image out of range
  virtual void setColorDetection(const ColorDetection& detection);

  /// Tells a channel which colours to detect, in place of what it had. The table is sent while the detection is on, and
  /// again after each reconnect. If the robot refuses it, such as for a channel that its camera does not have, the log
  /// says so.
  /// @param channel 0..7
  /// @param table null: the channel detects nothing any more
  /// @throw InvalidArgumentException channel out of range, or a range of the table is out of 0..255 or has a minimum
  ///   above its maximum
  virtual void setColorTable(int channel, ColorTablePtr table);

  /// True if a stream has been requested over the present connection and not been stopped since.
  virtual bool streaming() const;

  /// Waits for a picture that was taken after this call.
  ///
  /// The robot takes one picture of the given quality for this call alone. The exception is a running stream of a
  /// version 1 server: such a server must not be sent `F` while it streams, so the call gets the stream's next picture,
  /// at the stream's quality.
  ///
  /// A damaged picture is requested again, as long as the time allows. If the time passes while a version 1 server owes
  /// a picture, the client reconnects, since nothing would say which request the server's next picture answers.
  ///
  /// @param quality 0..100; 0 = the stream's quality
  /// @param timeout longest time to wait, 1 ms..1 h
  /// @param[out] stream_quality may be null; the quality of the running stream that the picture is from, 1..100, or 0
  ///   if it was taken for this call alone
  /// @param resolution none: the stream's
  /// @return the picture, never null
  /// @throw InvalidArgumentException quality or timeout out of range
  /// @throw NetworkException no connection, or it broke while waiting; the message says why and what to check, and
  ///   kind() names the reason
  /// @throw TimeoutException connected, but no picture came in time
  /// @throw CommandException the robot refused: it has no such resolution, or its server speaks version 1 and was asked
  ///   for another one than Resolution::kHigh
  /// @throw StoppedException stop() was called
  /// @throw Exception called from a callback
  virtual PicturePtr takePicture(int quality, std::chrono::milliseconds timeout, int* stream_quality = nullptr,
                                 std::optional<Resolution> resolution = std::nullopt);

  /// Sends joints to positions, all in one request. Returns without waiting for the answer, which goes to
  /// on_joints_accepted, or to on_refused if the robot refuses.
  ///
  /// A command is carried out once or not at all: without a connection it is refused, and commands that have not been
  /// sent when a connection breaks are dropped. If commands come faster than the robot answers, each joint goes to its
  /// latest target, and older ones that have not been sent are dropped. So are commands that had to wait for longer
  /// than their terms allow, because the robot was busy or the link stood still, and commands to the legs when steer()
  /// is called after them: on_refused tells.
  ///
  /// A version 1 server gets one joint after the other, each after the answer to the one before, and no duration, which
  /// such a server does not know: the joints move as fast as their speed limits allow. The terms say until when the
  /// first one may be sent; each further one may wait for kLongestOrderWait.
  ///
  /// @param targets 1..32 joints, each once
  /// @param duration 0..65535 ms until all joints arrive; 0 = each as fast as its limits allow
  /// @throw InvalidArgumentException an id, a position, the number of joints or the duration is out of range
  /// @throw NetworkException not connected; the message says why and what to check, and kind() names the reason
  /// @throw CommandException the server has no joints to command
  /// @throw StoppedException stop() was called
  virtual void commandJoints(const std::vector<JointTarget>& targets, std::chrono::milliseconds duration,
                             const OrderTerms& terms = {});

  /// Sets how fast joints may move. The limits are sent before later commands to the joints, under the same rules;
  /// after a reconnect they are not sent again.
  /// @param limits 1..32 joints, each once
  /// @throw as commandJoints()
  virtual void setJointSpeedLimits(const std::vector<JointSpeedLimit>& limits);

  /// Switches the motors of all joints on or off. While they are off, the joints can be moved by hand. Switching them
  /// off is sent before everything that waits, and drops commands to the joints and motions that have not been sent.
  /// @param timeout longest time to wait, 1 ms..1 h
  /// @return true if the robot says that its motors are now on
  /// @throw InvalidArgumentException timeout out of range
  /// @throw NetworkException no connection, or it broke while waiting
  /// @throw TimeoutException connected, but no answer came in time
  /// @throw CommandException the robot refused, or its server speaks version 1, which has no such request
  /// @throw StoppedException stop() was called
  /// @throw Exception called from a callback
  virtual bool setMotors(bool on, std::chrono::milliseconds timeout);

  /// Stops joints: each brakes within its limits and stays where it comes to rest. Motions that move one of them end.
  /// This is sent before everything that waits. Commands to these joints that have not been sent are dropped, and so
  /// are motions that have not been sent: their callers get a CommandException. Returns when the robot has answered.
  /// @param joints 0..32 identifiers of joints, each once; none = everything that moves
  /// @param timeout longest time to wait, 1 ms..1 h
  /// @throw InvalidArgumentException an argument is out of range
  /// @throw NetworkException no connection, or it broke while waiting: the robot may or may not have obeyed
  /// @throw TimeoutException connected, but no answer came in time
  /// @throw CommandException the robot refused, or its server speaks version 1 or lacks the capability `I`; nothing was
  ///   sent or dropped then, and the message says what to do instead
  /// @throw StoppedException stop() was called
  /// @throw Exception called from a callback
  virtual void hold(const std::vector<int>& joints, std::chrono::milliseconds timeout);

  /// Lets the robot walk with a velocity. Returns without waiting for the answer, which goes to on_steered, or to
  /// on_refused if the robot refuses.
  ///
  /// The robot stops walking and stands 500 ms after it was steered last, so call this again and again. A velocity of 0
  /// stops it at once, in an orderly way. A robot that does not stand yet first stands up.
  ///
  /// The newest velocity counts: an older one that has not been sent is dropped. So is one that had to wait for longer
  /// than its terms allow, and one that is followed by hold(), takePosture(), motors off or a command to the legs
  /// before it is sent: on_refused tells. Without a connection it is refused, and nothing is repeated after a
  /// reconnect.
  ///
  /// @param velocity at most 32.767 m/s and rad/s; the robot keeps to its limits (RobotInfo::walk_limits)
  /// @throw InvalidArgumentException velocity out of range or not a number
  /// @throw NetworkException not connected; the message says why and what to check, and kind() names the reason
  /// @throw CommandException the server speaks version 1 or lacks the capability `S`
  /// @throw StoppedException stop() was called
  virtual void steer(const WalkVelocity& velocity, const OrderTerms& terms = {});

  /// Lets the robot take a posture. It ends a walk and the motions that move legs. Returns when the robot has begun; a
  /// MotionEnd with the posture's name says when and how it has ended: "stand", "sit" or "rest". A call that has not
  /// been sent when hold() is called, or when its terms end, ends with a CommandException.
  /// @param timeout longest time to wait, 1 ms..1 h
  /// @throw InvalidArgumentException timeout out of range
  /// @throw NetworkException no connection, or it broke while waiting; wasSent() says whether the robot may have obeyed
  /// @throw TimeoutException connected, but no answer came in time. If wasSent(), the robot may still obey:
  ///   on_late_answer tells
  /// @throw CommandException the robot refused, or its server speaks version 1 or lacks the capability `E`
  /// @throw StoppedException stop() was called
  /// @throw Exception called from a callback
  virtual void takePosture(Posture posture, std::chrono::milliseconds timeout, const OrderTerms& terms = {});

  /// Sets LEDs. Returns without waiting, under the same rules as commandJoints(): if commands come faster than the
  /// robot answers, each LED gets its latest one. The answer goes to on_leds_accepted, or to on_refused if the robot
  /// refuses.
  ///
  /// A version 1 server gets one LED after the other, and the intensity alone: its only request with a mode sets all
  /// LEDs at once. That request is sent if a command gives all 26 LEDs of an ERS-7 the same intensity and mode.
  ///
  /// @param leds 1..32 LEDs, each once
  /// @throw InvalidArgumentException an id, an intensity or the number of LEDs is out of range
  /// @throw NetworkException not connected; the message says why and what to check
  /// @throw CommandException the server has no LEDs to command
  /// @throw StoppedException stop() was called
  virtual void commandLeds(const std::vector<LedCommand>& leds);

  /// Flicks the ears. The robot lets go of a drawn ear after 128 ms, because the ear's magnet must not stay energised.
  /// Returns without waiting, as commandLeds().
  /// @param left true = draw the ear, false = let it go at once
  /// @param right the same
  /// @throw NetworkException, CommandException, StoppedException as commandLeds()
  virtual void commandEars(bool left, bool right);

  /// Plays a motion from the robot's memory stick (a file in Sony's format MTN). Returns when the robot has begun.
  /// Motions that move different joints play at the same time. The robot stops them when this client disconnects.
  ///
  /// This function and those down to rebootRobot() send one request and wait for its answer. If a version 1 server
  /// does not answer in time, the client reconnects, since nothing would say which request the server's next answer
  /// belongs to. All of them
  /// @throw InvalidArgumentException an argument is out of range, or `name` is not the name of a motion
  /// @throw NetworkException no connection, or it broke while waiting; wasSent() says whether the robot may have obeyed
  /// @throw TimeoutException connected, but no answer came in time. If wasSent(), the robot may still obey
  /// @throw CommandException the robot refused, or its server has no such request; the message says why, and what to do
  /// @throw StoppedException stop() was called
  /// @throw Exception called from a callback
  ///
  /// @param name of the file, such as NOD.MTN: 8 characters at most, then .MTN, in capitals or not
  /// @param repetitions 1..65535
  /// @param timeout longest time to wait, 1 ms..1 h
  /// @param terms a call that could not be sent in time, such as while the memory stick was at work for another one,
  ///   ends with a CommandException
  /// @return what the robot plays differently than the file says, in one line: positions that it clips, by how much the
  ///   motion is longer because it is too fast for the joints' speed limits, joints left out; empty if nothing, and
  ///   with a server that does not tell (version 1, or older than this)
  virtual std::string playMotion(const std::string& name, int repetitions, std::chrono::milliseconds timeout,
                                 const OrderTerms& terms = {});

  /// Stops a motion. Its joints hold their positions. With a version 2 server, calls to play it that have not been sent
  /// end with a CommandException.
  /// @param name of the motion; empty = all that are playing
  /// @param timeout longest time to wait, 1 ms..1 h
  virtual void stopMotion(const std::string& name, std::chrono::milliseconds timeout);

  /// Writes a motion to the robot's memory stick, replacing one of this name. The robot's RCSERVER.CFG has to allow it
  /// (ALLOW_UPLOAD). Pictures go on meanwhile; a version 1 server gets no other request until the upload is done.
  /// @param content the file's bytes, 1..65523: as much as fits into a request of version 2 beside a name. This
  ///   project's RCServer accepts motions of up to 64000 bytes.
  /// @param timeout longest time to wait, 1 ms..1 h
  virtual void uploadMotion(const std::string& name, const std::vector<std::uint8_t>& content,
                            std::chrono::milliseconds timeout);

  /// Deletes a motion from the robot's memory stick. RCSERVER.CFG has to allow it (ALLOW_DELETE).
  /// @param timeout longest time to wait, 1 ms..1 h
  virtual void deleteMotion(const std::string& name, std::chrono::milliseconds timeout);

  /// The names of the motions on the robot's memory stick. Version 1 of the protocol has no such request.
  /// @param timeout longest time to wait, 1 ms..1 h
  virtual std::vector<std::string> listMotions(std::chrono::milliseconds timeout);

  /// Takes a picture of 208x160 onto the robot's memory stick, where it stays even if the connection ends.
  /// RCSERVER.CFG has to allow this and the next three functions (ALLOW_PICTURES), which version 1 of the protocol does
  /// not have. The robot refuses if its memory stick is full, write-protected or missing, or has 256 pictures.
  /// @param quality 1..100
  /// @param timeout longest time to wait, 1 ms..1 h
  /// @return the name of the file, such as AIBO0001.JPG: no other one has been replaced
  virtual std::string takePictureOnRobot(int quality, std::chrono::milliseconds timeout);

  /// The names of the pictures on the robot's memory stick.
  /// @param timeout longest time to wait, 1 ms..1 h
  virtual std::vector<std::string> listPictures(std::chrono::milliseconds timeout);

  /// Gets a picture from the robot's memory stick, where it stays. While it is on its way, nothing else comes from the
  /// robot: a picture of 6 KB takes as long as one of the stream, the largest, 128 KiB, half a second at 2 Mbit/s.
  /// @param name of the file: 8 characters at most, then .JPG, in capitals or not
  /// @param timeout longest time to wait, 1 ms..1 h
  /// @return the file's bytes: a whole picture of a size that the camera has (jpeg_inspector.h). A file that is
  ///   anything else is refused with a CommandException
  virtual std::vector<std::uint8_t> fetchPicture(const std::string& name, std::chrono::milliseconds timeout);

  /// Deletes a picture from the robot's memory stick. RCSERVER.CFG has to allow that, too (ALLOW_DELETE).
  /// @param timeout longest time to wait, 1 ms..1 h
  virtual void deletePicture(const std::string& name, std::chrono::milliseconds timeout);

  /// Switches off the motors, so that the robot sinks down, and then the robot. RCSERVER.CFG has to allow it
  /// (ALLOW_SHUT_DOWN). The connection ends after the answer; this client keeps trying to reconnect.
  /// @param timeout longest time to wait, 1 ms..1 h
  virtual void shutDownRobot(std::chrono::milliseconds timeout);

  /// The same, but the robot then starts again (ALLOW_REBOOT).
  /// @param timeout longest time to wait, 1 ms..1 h
  virtual void rebootRobot(std::chrono::milliseconds timeout);

  /// Sets how often the robot sends telemetry, in OPEN-R frames of 8 ms. Takes effect as setStreaming() does.
  ///
  /// A version 1 server sends none. While telemetry is wanted, the client asks it for joints and sensors in turn, 20 of
  /// each a second whatever the period, so that the answers hardly slow the stream of pictures down. Such a server does
  /// not say which robot it runs on: the client assumes an ERS-7.
  ///
  /// @param frames 0..65535; 0 = no telemetry; 4 (32 ms) is as often as the robot measures
  /// @throw InvalidArgumentException frames out of range
  virtual void setTelemetryPeriod(int frames);

  /// What the robot last said of its motors and its posture; unknown without a connection.
  virtual MotorsAndPosture motorsAndPosture() const;

  /// A snapshot of the connection's state.
  virtual ConnectionStatus status() const;

  /// A snapshot of the counters.
  virtual ClientStatistics statistics() const;

 private:
  const int motion_bits_;  // of the id in requests about motions (protocol/motion_requests.h)
  std::unique_ptr<ConnectionLoop> loop_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_RCSERVER_CLIENT_H
