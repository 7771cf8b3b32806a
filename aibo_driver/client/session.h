/// @file session.h
#ifndef AIBO_DRIVER_CLIENT_SESSION_H
#define AIBO_DRIVER_CLIENT_SESSION_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "aibo_client/camera.h"
#include "aibo_client/sound.h"
#include "client/call.h"
#include "client/color_intake.h"

namespace aibo_client {

/// What the user wants over the present connection and over each later one.
struct Settings {
  bool streaming = false;
  int jpeg_quality = 0;      ///< 1..100, for the stream
  int telemetry_period = 0;  ///< OPEN-R frames of 8 ms; 0 means no telemetry
  StreamFormat format{};
  CameraSettings camera{};
  PictureTransport transport = PictureTransport::kTcp;
  int datagram_port = 0;  ///< the port to which pictures can be sent by UDP; 0 if they have to come by TCP
  ColorDetection colors{};
  ColorTables color_tables{};  ///< sent only while colours are detected
  MicrophoneSettings microphone{};
  bool guard_walks = true;                ///< for the velocities that the user gives from now on
  bool leave_out_missing_joints = false;  ///< in motions
};

/// Speaks one version of the protocol over one Connection. It knows what to send, how to parse what arrives, and when
/// to give up. It does no I/O and reads no clock: its caller gives it bytes and times. Only one thread may use it.
class Session {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  using Bytes = std::vector<std::uint8_t>;

  Session() = default;
  virtual ~Session() = default;
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  virtual int protocolVersion() const = 0;

  /// True once the server has answered. From then on, requests can be made.
  virtual bool ready() const = 0;

  /// The request to send now. It is empty if there is none. A request that was returned counts as sent. Whenever
  /// anything may have changed, call this until nothing is left. Each request has to be sent in one piece, because some
  /// servers recognise a request by the number of bytes that arrive at once.
  virtual Bytes nextRequest(const Settings& wanted, TimePoint now) = 0;

  /// Call this when bytes were read.
  /// @throw ProtocolException no server of this version sends these bytes
  /// @throw Fault the connection cannot go on
  virtual void bytesArrived(const std::uint8_t* data, std::size_t size, TimePoint now) = 0;

  /// Call this when a datagram has come from the server's address.
  /// @return true if replies should go to its sender
  /// @throw the exceptions of bytesArrived()
  virtual bool datagramArrived(const std::uint8_t* data, std::size_t size, TimePoint now) = 0;

  /// The datagram to send to the server now; empty if there is none. Call this after datagramArrived() and
  /// checkDeadlines().
  virtual Bytes takeReply(TimePoint now) = 0;

  /// Call this when nextDeadline() has passed and everything that had arrived until then has been handed in.
  /// @throw Fault something was due and did not come
  virtual void checkDeadlines(TimePoint now) = 0;

  /// The latest time to look at the socket and to call checkDeadlines() and nextRequest() again.
  virtual TimePoint nextDeadline() const = 0;
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_SESSION_H
