/// @file status.h
#ifndef AIBO_CLIENT_STATUS_H
#define AIBO_CLIENT_STATUS_H

#include <cstdint>
#include <string>

#include "aibo_client/camera.h"
#include "aibo_client/exceptions.h"
#include "aibo_client/robot_info.h"

namespace aibo_client {

/// How far the client has got.
enum class ConnectionState {
  kDisconnected,
  kConnecting,  ///< also while a connection exists but the robot has not answered yet
  kConnected
};

/// The state of the connection to the robot.
struct ConnectionStatus {
  ConnectionState state = ConnectionState::kDisconnected;
  int protocol_version = 0;            ///< 1 or 2 once connected; 0 otherwise
  std::string reason;                  ///< why the last connection or attempt ended; empty when all is well
  std::string advice;                  ///< what the user should check; empty when all is well
  FaultKind fault = FaultKind::kNone;  ///< the same reason as `reason`, for programs; kNone when all is well
  RobotInfo robot;                     ///< the introduction of a version 2 server once connected; otherwise empty
  /// The last report that a version 2 server sent without a request. For example, a joint does not move, or the server
  /// hangs up for some reason. The report is kept until the next connection. A report about a joint ends when the
  /// server says that the joint follows its commands again; then the last report before it that still holds is here. It
  /// is empty if there is none.
  std::string robot_message;
  PictureTransport transport = PictureTransport::kTcp;  ///< how the pictures of the stream come now
  std::string transport_problem;  ///< why they come by TCP although UDP is wanted; empty if all is well
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
  std::uint64_t thinned_telemetry = 0;  ///< telemetry dropped: it came more than twice as often as requested
  std::uint64_t thinned_colors = 0;     ///< detected colours dropped: they came more than twice as often as requested
  std::uint64_t sounds = 0;             ///< pieces of heard sound that were delivered
  std::uint64_t sound_gaps = 0;         ///< how often sound was missing between two pieces
  std::uint64_t thinned_sounds = 0;     ///< pieces dropped: more than twice as much came as requested
  std::uint64_t impossible_values = 0;  ///< values dropped from telemetry or detected colours: no robot can have them
  std::uint64_t refusals = 0;           ///< requests that the robot refused

  /// @name Pictures by UDP
  /// @{
  std::uint64_t datagrams = 0;            ///< datagrams received from the robot
  std::uint64_t lost_datagrams = 0;       ///< datagrams that had not come when 64 later ones had been sent
  std::uint64_t reordered_datagrams = 0;  ///< datagrams that came behind later ones
  std::uint64_t duplicate_datagrams = 0;  ///< datagrams that came a second time
  std::uint64_t bad_datagrams = 0;        ///< datagrams dropped: from the robot's address, but no part of a picture
  std::uint64_t foreign_datagrams = 0;    ///< datagrams dropped: they came from another address
  std::uint64_t repaired_datagrams = 0;   ///< datagrams that were lost or late and were made from others
  std::uint64_t lost_pictures = 0;        ///< pictures of which a datagram was lost or came too late
  /// @}
};

}  // namespace aibo_client

#endif  // AIBO_CLIENT_STATUS_H
