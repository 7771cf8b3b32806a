/// @file rcserver_client.h
/// The client of the robot's RCServer. It does not depend on ROS.
#ifndef AIBO_CLIENT_RCSERVER_CLIENT_H
#define AIBO_CLIENT_RCSERVER_CLIENT_H

#include <chrono>
#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "aibo_client/callbacks.h"
#include "aibo_client/exceptions.h"
#include "aibo_client/names.h"
#include "aibo_client/options.h"
#include "aibo_client/sound.h"

namespace aibo_client {

class ConnectionLoop;
class TcpTransport;

/// Keeps one connection to an RCServer. Over this connection it receives pictures and telemetry, moves the joints, and
/// sends the robot every other request that its server supports.
///
/// A thread of its own connects, splits the byte stream into pictures and replies, and reconnects after every fault,
/// with growing, jittered waits. It asks each server for version 2 of the protocol. It falls back to version 1 if the
/// server refuses or does not answer within 500 ms. In the latter case it asks the server for a picture, unless the
/// stream is wanted, and drops that picture. The client counts as connected only once the server has answered.
///
/// After a reconnect, the stream and telemetry are requested again if they are still wanted. A single picture is not
/// requested again, and no command is ever repeated: the robot carries it out once or not at all. All waiting uses the
/// steady clock and ends at once when stop() is called. Times and ranges are our choice.
///
/// Any thread may call every member function, unless its comment says otherwise.
///
/// @code
/// aibo_client::ClientOptions options;
/// options.host = "192.168.1.20";
/// aibo_client::RcServerClient robot(options, {});
/// robot.start();
/// robot.waitForConnection(5s);
/// const aibo_client::PicturePtr picture = robot.takePicture(85, 2s);
/// robot.takePosture(aibo_client::Posture::kStand, 2s);
/// @endcode
class RcServerClient {
 public:
  /// Constructs the client without connecting it; start() does that.
  /// @throw InvalidArgumentException an option is out of its range; the message names both
  RcServerClient(const ClientOptions& options, Callbacks callbacks);

  /// Calls stop().
  ~RcServerClient();

  RcServerClient(const RcServerClient&) = delete;
  RcServerClient& operator=(const RcServerClient&) = delete;

  /// Begins to connect. Further calls do nothing.
  /// @throw Exception stop() was called before; a client that was stopped stays stopped
  void start();

  /// Waits until the robot has answered. Meanwhile the client tries again after every fault.
  /// @param timeout the longest time to wait, 1 ms..1 h
  /// @throw InvalidArgumentException timeout is out of range
  /// @throw NetworkException there is still no connection; the message says why and what to check, and kind() names the
  ///   reason
  /// @throw StoppedException stop() was called
  /// @throw Exception the function was called from a callback
  void waitForConnection(std::chrono::milliseconds timeout);

  /// Ends the connection and the thread, in every state within a second. Calls in progress end with StoppedException.
  /// No callback runs after it has returned. Further calls do nothing.
  void stop() noexcept;

  /// @name Settings
  /// A setting takes effect at once if connected, otherwise as soon as there is a connection, and again after each
  /// reconnect. A robot can refuse a setting, and a server of version 1 lacks all of them except for the stream, its
  /// quality and telemetry. In both cases the log says so.
  /// @throw InvalidArgumentException an argument is out of range
  /// @{

  /// Switches the stream of pictures on or off. It sends nothing if the stream is already as wanted.
  void setStreaming(bool on);

  /// Sets the quality of the stream's pictures. A version 2 server changes a running stream at once; a version 1 server
  /// uses the new quality when the stream is next started.
  /// @param quality 1..100
  void setJpegQuality(int quality);

  /// The last quality that setJpegQuality() set, 1..100. At first it is ClientOptions::jpeg_quality.
  int jpegQuality() const;

  /// Sets the resolution and the rate of the stream. A running stream changes at once. A version 1 server can only send
  /// every image in Resolution::kHigh. A camera may lack the bands for Resolution::kDouble; then the stream has
  /// Resolution::kHigh.
  void setStreamFormat(const StreamFormat& format);

  /// The last format that setStreamFormat() set.
  StreamFormat streamFormat() const;

  /// Sets how the pictures of the stream are sent. If the server speaks version 1, they come by TCP.
  ///
  /// A datagram is accepted only from the robot's address. A picture is delivered when all its datagrams have come, but
  /// never after a newer picture. The pictures come by TCP if none comes by UDP for 1 s although TCP works, or if 20
  /// pictures in a row have lost a datagram: see ConnectionStatus::transport_problem. The robot is asked for a test
  /// datagram a minute later, or when this is set to TCP and then to UDP.
  void setPictureTransport(PictureTransport transport);

  /// Sets the camera. The robot resets the camera when the connection ends. Picture::settings has the settings with
  /// which a picture was taken.
  void setCameraSettings(const CameraSettings& settings);

  /// Switches the detection of colours on or off. It does not need the stream.
  void setColorDetection(const ColorDetection& detection);

  /// Sets the colours that a channel detects. They replace its old ones. The table is sent while the detection is on.
  /// The robot refuses it if its camera does not have this channel.
  /// @param channel 0..7
  /// @param table null means that the channel detects nothing any more
  /// @throw InvalidArgumentException also if a range of the table goes beyond 0..255 or has a minimum above its maximum
  void setColorTable(int channel, ColorTablePtr table);

  /// Switches the robot's microphones on or off. It does not need the stream. Two channels at 16000 samples/s take 520
  /// kbit/s. The robot refuses unless its RCSERVER.CFG allows it (ALLOW_MICROPHONE), and on_refused reports this.
  void setMicrophone(const MicrophoneSettings& settings);

  /// Sets how often the robot sends telemetry, in OPEN-R frames of 8 ms.
  ///
  /// A version 1 server sends no telemetry by itself, so the client asks it for joints and sensors in turn. It asks for
  /// each about once a second, whatever the period, so that the answers hardly slow down the stream. Such a server does
  /// not say which robot it runs on, so the client assumes an ERS-7.
  ///
  /// @param frames 0..65535; 0 means no telemetry; 4 (32 ms) is as often as the robot measures
  void setTelemetryPeriod(int frames);
  /// @}

  /// True if a stream has been requested over the present connection and has not been stopped since.
  bool streaming() const;

  /// @name Commands
  /// Each function sends a request and returns without waiting for the answer. The answer goes to the callback that the
  /// function names, or to on_refused if the robot refuses. A command is carried out once or not at all: nothing is
  /// repeated after a reconnect. If commands come faster than the robot answers, each joint, LED and ear gets its
  /// latest command, and the walk its latest velocity. Older ones that have not been sent are dropped.
  /// @throw InvalidArgumentException an argument is out of range
  /// @throw NetworkException the robot is not connected; the message says why and what to check, and kind() names the
  ///   reason
  /// @throw StoppedException stop() was called
  /// @{

  /// Sends joints to positions, all in one request, and then calls on_joints_accepted. Targets with a speed first limit
  /// the speeds of their joints, as setJointSpeedLimits() does. on_refused reports that the last target of a command
  /// was dropped, or that it reached the robot too late. on_ended reports that no joint moves for this command any
  /// more. The command is done if each joint that no other order has taken was measured within 0.05 rad of its target.
  ///
  /// A version 1 server gets one joint at a time, each after the answer to the previous one. Such a server does not
  /// know durations, so the joints move as fast as their speed limits allow. The terms say until when the first target
  /// may be sent. Each further one may wait for kLongestOrderWait.
  ///
  /// @param targets 1..32 joints; each joint appears once
  /// @param duration 0..65535 ms until all joints arrive; 0 means that each moves as fast as its limits allow
  /// @param terms the latest time at which the command may be sent, and the order's number
  void commandJoints(const std::vector<JointTarget>& targets, std::chrono::milliseconds duration,
                     const OrderTerms& terms = {});

  /// Sets how fast joints may move in all movements. The robot itself keeps the limits. They are sent before later
  /// commands to the joints, unless the robot has them already.
  /// @param limits 1..32 joints; each joint appears once
  void setJointSpeedLimits(const std::vector<JointSpeedLimit>& limits);

  /// Makes the robot walk with a velocity, and then calls on_steered.
  ///
  /// The robot stops walking and stands 500 ms after the last call, so call this again and again. A velocity of 0 stops
  /// it at once, in an orderly way. A robot that does not stand yet first stands up.
  ///
  /// A walk begins only after a velocity of 0, which says that the user has released the controls. This velocity has to
  /// come after the connection was made, after anything else that took or held a leg, after a fall, and after an end or
  /// a refusal by the robot. A velocity of 0 is sent before everything that waits, except for what stops the robot.
  /// Only a newer velocity of 0 and a stop drop it.
  ///
  /// on_refused reports a velocity that was dropped for a newer one or because of hold(), takePosture(), motors off or
  /// a command to the legs.
  ///
  /// @param velocity at most 32.767 m/s and rad/s; the robot keeps its limits (RobotInfo::walk_limits)
  /// @param terms until when the velocity may reach the robot, and its number; a velocity of 0 is never too old
  /// @throw CommandException the server speaks version 1 or lacks the capability `S`
  void steer(const WalkVelocity& velocity, const OrderTerms& terms = {});

  /// Changes ClientOptions::guard_walks. The change takes effect at the next call of steer(), even during a walk.
  void guardWalks(bool on);

  /// Sets LEDs, and then calls on_leds_accepted.
  ///
  /// A version 1 server gets one LED after the other, and only the intensity, because its only request with a mode sets
  /// all LEDs at once.
  ///
  /// @param leds 1..32 LEDs; each LED appears once
  void commandLeds(const std::vector<LedCommand>& leds);

  /// Flicks the ears. The robot releases a drawn ear after 128 ms, because the ear's magnet must not stay energised.
  /// @param left true: draw the left ear; false: release it at once
  /// @param right true: draw the right ear; false: release it at once
  void commandEars(bool left, bool right);
  /// @}

  /// @name Requests that wait for their answer
  /// Each function sends one request and waits for its answer, at most as long as `timeout` says, 1 ms..1 h. The
  /// begin... functions do the same as those beside them without waiting: a future gets the result or the exception
  /// within the timeout. If a begin... function itself throws, it has given no order, and no callback names the order.
  ///
  /// If an order has a number, on_refused or on_ended also reports how it has ended. A refusal is reported before the
  /// function ends. An order that has not been sent within the timeout is withdrawn (RefusalCause::kTooOld).
  ///
  /// If a version 1 server does not answer in time, the client reconnects. Otherwise it could not know which request
  /// the server's next answer belongs to.
  /// @throw InvalidArgumentException an argument is out of range, or a name is not that of a motion or a picture
  /// @throw NetworkException there is no connection, or it broke while waiting; the message says why and what to check,
  ///   kind() names the reason, and wasSent() says whether the robot may have obeyed
  /// @throw TimeoutException the robot is connected, but no answer came in time. If wasSent(), the robot may still obey
  /// @throw CommandException the robot refused, or its server has no such request; the message says why, and what to do
  /// @throw StoppedException stop() was called
  /// @throw Exception the function was called from a callback; only the begin... functions may be called there
  /// @{

  /// Waits for a picture that was taken after this call.
  ///
  /// The robot takes one picture of the given quality for this call alone. The exception is a running stream of a
  /// version 1 server. Such a server must not get `F` while it streams, so the call returns the stream's next picture,
  /// at the stream's quality: see Picture::quality.
  ///
  /// A damaged picture is requested again as long as time is left.
  /// @param quality 0..100; 0 means the stream's quality
  /// @param resolution empty means the stream's resolution
  /// @return the picture, never null
  /// @throw CommandException also if the robot has no such resolution; one of version 1 has only Resolution::kHigh
  PicturePtr takePicture(int quality, std::chrono::milliseconds timeout,
                         std::optional<Resolution> resolution = std::nullopt);

  /// Switches the motors of all joints on or off. While they are off, the joints can be moved by hand. The request to
  /// switch them off is sent before everything that waits. Orders that have not been sent are dropped.
  /// @param on true: on; false: off
  /// @param terms until when the motors may be switched on; to switch them off is never too late. The order's number is
  ///   ignored, because this request ends with its answer
  /// @return true if the robot says that its motors are now on
  bool setMotors(bool on, std::chrono::milliseconds timeout, const OrderTerms& terms = {});
  std::future<bool> beginMotors(bool on, std::chrono::milliseconds timeout, const OrderTerms& terms = {});

  /// Stops joints. Each of them brakes within its limits and stays where it comes to rest. Motions that move one of
  /// them end. This request is sent before everything that waits. Commands to these joints that have not been sent are
  /// dropped. Motions, postures and requests to switch the motors on that have not been sent are dropped, too: their
  /// callers get a CommandException. It returns when the robot has answered.
  /// @param joints 0..32 identifiers of joints; each appears once. If it is empty, everything that moves stops
  /// @throw CommandException also if the server speaks version 1; then nothing was sent or dropped
  void hold(const std::vector<int>& joints, std::chrono::milliseconds timeout);
  std::future<void> beginHold(const std::vector<int>& joints, std::chrono::milliseconds timeout);

  /// Makes the robot take a posture. This ends a walk and the motions that move legs. It returns when the robot has
  /// begun. on_ended reports when and how the posture has ended. If a call has not been sent when hold() is called or
  /// its terms end, the call throws a CommandException.
  /// @param posture the posture
  /// @param terms until when the request may reach the robot, and its number
  /// @throw CommandException also if the server lacks the capability `E`, because its robot does not walk
  void takePosture(Posture posture, std::chrono::milliseconds timeout, const OrderTerms& terms = {});
  std::future<void> beginPosture(Posture posture, std::chrono::milliseconds timeout, const OrderTerms& terms = {});

  /// Plays a motion from the robot's memory stick (a file in Sony's format MTN). It returns when the robot has begun.
  /// Motions that move different joints play at the same time. The robot stops them when this client disconnects.
  /// @param name the name of the file, such as NOD.MTN: at most 8 characters, then .MTN, in upper or lower case
  /// @param repetitions 1..65535
  /// @param terms until when the request may reach the robot, and its number. The robot may take 5 s longer to read the
  ///   file. If the request could not be sent in time, for example because the memory stick was busy with another
  ///   request, the call ends with a CommandException
  /// @return what the robot plays differently from the file, in one line: positions that it clips, by how much the
  ///   motion is longer because it is too fast for the joints' speed limits, and joints that it leaves out. It is empty
  ///   if nothing differs, or if the server speaks version 1, which does not report this
  std::string playMotion(const std::string& name, int repetitions, std::chrono::milliseconds timeout,
                         const OrderTerms& terms = {});
  std::future<std::string> beginMotion(const std::string& name, int repetitions, std::chrono::milliseconds timeout,
                                       const OrderTerms& terms = {});

  /// Stops a motion. Its joints hold their positions. With a version 2 server, calls that have not been sent and would
  /// play this motion end with a CommandException.
  /// @param name the name of the motion; empty means all that are playing
  void stopMotion(const std::string& name, std::chrono::milliseconds timeout);

  /// Writes a motion to the robot's memory stick. It replaces a motion of the same name. The robot's RCSERVER.CFG has
  /// to allow it (ALLOW_UPLOAD). The stream goes on meanwhile. A version 1 server gets no other request until the
  /// upload is done.
  /// @param name the name of the file, as for playMotion()
  /// @param content the file's bytes, 1..65523: a request of version 2 has no room for more besides the name. This
  ///   project's RCServer accepts motions of up to 64000 bytes
  void uploadMotion(const std::string& name, const std::vector<std::uint8_t>& content,
                    std::chrono::milliseconds timeout);

  /// Deletes a motion from the robot's memory stick. RCSERVER.CFG has to allow it (ALLOW_DELETE).
  /// @param name the name of the file, as for playMotion()
  void deleteMotion(const std::string& name, std::chrono::milliseconds timeout);

  /// The names of the motions on the robot's memory stick. Version 1 of the protocol has no such request.
  std::vector<std::string> listMotions(std::chrono::milliseconds timeout);

  /// Takes a picture of 208x160 and stores it on the robot's memory stick. It stays on the stick even if the connection
  /// ends. RCSERVER.CFG has to allow this and the next three functions (ALLOW_PICTURES). Version 1 of the protocol does
  /// not have them. The robot refuses if its memory stick is full, write-protected or missing, or has 256 pictures.
  /// @param quality 1..100
  /// @return the name of the new file, such as AIBO0001.JPG; it has not replaced another file
  std::string takePictureOnRobot(int quality, std::chrono::milliseconds timeout);

  /// The names of the pictures on the robot's memory stick.
  std::vector<std::string> listPictures(std::chrono::milliseconds timeout);

  /// Gets a picture from the robot's memory stick and leaves it there. While the picture is on its way, nothing else
  /// comes from the robot. A picture of 6 KB takes as long as one of the stream. The largest picture, 128 KiB, takes
  /// half a second at 2 Mbit/s.
  /// @param name the name of the file: at most 8 characters, then .JPG, in upper or lower case
  /// @return the file's bytes: a whole picture of a size that the camera has (jpeg_inspector.h). Any other file is
  ///   refused with a CommandException
  std::vector<std::uint8_t> fetchPicture(const std::string& name, std::chrono::milliseconds timeout);

  /// Deletes a picture from the robot's memory stick. RCSERVER.CFG has to allow both (ALLOW_DELETE, ALLOW_PICTURES).
  /// @param name the name of the file, as for fetchPicture()
  void deletePicture(const std::string& name, std::chrono::milliseconds timeout);

  /// Switches off the motors, so that the robot sinks down, and then the robot itself. RCSERVER.CFG has to allow it
  /// (ALLOW_SHUT_DOWN). The connection ends after the answer. This client keeps trying to reconnect.
  void shutDownRobot(std::chrono::milliseconds timeout);

  /// Does the same as shutDownRobot(), but the robot then starts again (ALLOW_REBOOT).
  void rebootRobot(std::chrono::milliseconds timeout);

  /// Sends the next samples of a sound, and waits for the robot's answer. Other requests are sent first, or wait for at
  /// most one request with samples, so sound does not delay hold(). At first, send kMostSamplesAtOnce. After that, keep
  /// ahead of the robot: it plays silence in place of samples that come too late. After 2 s without samples it ends the
  /// sound.
  ///
  /// A sound belongs to one connection: a reconnect ends it. If this call throws, the sound cannot go on. The robot's
  /// RCSERVER.CFG can forbid sounds (ALLOW_SOUND).
  /// @param sound 0 begins a new sound, which replaces the present one; otherwise the number that this call returned
  /// @param samples mono, kSoundRate a second; 1..kMostSamplesAtOnce, and no more than SoundProgress::room of the
  ///   last answer plus what the robot has played since
  /// @param is_last true: the sound ends with these samples
  /// @throw CommandException also if the sound has ended or was replaced
  SoundProgress playSamples(std::uint64_t sound, const std::vector<std::int16_t>& samples, bool is_last,
                            std::chrono::milliseconds timeout);

  /// Stops the sound that plays, if there is one. Up to 64 ms of it are still heard.
  void stopSound(std::chrono::milliseconds timeout);

  /// Sets the volume. It holds until this client disconnects.
  /// @param volume 0 (silent)..kLoudestVolume, or kVolumeOfRobot
  /// @return the volume in force, 0..kLoudestVolume
  int setVolume(int volume, std::chrono::milliseconds timeout);
  /// @}

  /// The robot's last report about its motors and its posture. It is unknown without a connection.
  MotorsAndPosture motorsAndPosture() const;

  /// A snapshot of the connection's state.
  ConnectionStatus status() const;

  /// The same as status().robot.design, without a copy of everything else.
  std::string robotDesign() const;

  /// A snapshot of the counters.
  ClientStatistics statistics() const;

 protected:
  /// Constructs a client with a transport of its own.
  RcServerClient(const ClientOptions& options, Callbacks callbacks, std::unique_ptr<TcpTransport> transport);

 private:
  std::unique_ptr<ConnectionLoop> loop_;
};

}  // namespace aibo_client

#endif  // AIBO_CLIENT_RCSERVER_CLIENT_H
