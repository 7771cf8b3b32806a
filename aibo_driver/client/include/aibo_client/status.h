/// @file status.h
#ifndef AIBO_CLIENT_STATUS_H
#define AIBO_CLIENT_STATUS_H

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "aibo_client/camera.h"
#include "aibo_client/exceptions.h"
#include "aibo_client/parts.h"
#include "aibo_client/walk.h"

namespace aibo_client {

/// How a version 2 server introduces itself. It is empty for a version 1 server, which does not introduce itself.
struct RobotInfo {
  std::string design;                     ///< the robot's design, as OPEN-R names it: "ERS-7"
  std::string server;                     ///< the name and version of the server
  std::vector<std::string> capabilities;  ///< the letters of the requests that it serves: "F", "J", "O"...
  std::vector<JointLimits> joint_limits;  ///< the limits of each joint
  WalkLimits walk_limits;

  /// @param word the letter of a request
  bool hasCapability(const std::string& word) const {
    return std::find(capabilities.begin(), capabilities.end(), word) != capabilities.end();
  }
};

/// How far the connection has been made.
enum class ConnectionState {
  kDisconnected,
  kConnecting,  ///< also while a connection exists but the robot has not answered yet
  kConnected
};

/// The state of the connection to the robot.
struct ConnectionStatus {
  ConnectionState state = ConnectionState::kDisconnected;
  int protocol_version = 0;  ///< 1 or 2 once connected; 0 otherwise
  /// Why the last connection or attempt ended; empty when all is well. If the robot has said why it goes off, this
  /// text begins with that until the robot answers again.
  std::string reason;
  std::string advice;                  ///< what the user should check; empty when all is well
  FaultKind fault = FaultKind::kNone;  ///< the same reason as `reason`, for programs; kNone when all is well
  RobotInfo robot;                     ///< the introduction of a version 2 server once connected; otherwise empty
  /// The last report that a version 2 server sent without a request. For example, it says that a joint does not move,
  /// or why the server hangs up. The report is kept until the next connection. A report about a joint ends when the
  /// server says that the joint follows its commands again. After that, this is the last earlier report that still
  /// holds, or empty.
  std::string robot_message;
  PictureTransport transport = PictureTransport::kTcp;         ///< how the pictures of the stream come now
  PictureTransport wanted_transport = PictureTransport::kTcp;  ///< as last set by the user
  /// Why the pictures come by TCP although UDP is wanted. It is empty if they do come by UDP, if TCP is wanted, or if
  /// UDP has not been tried yet.
  std::string transport_problem;
};

/// A number that one thread counts while other threads read it. A copy has the value of that moment.
class Counter {
 public:
  Counter(std::uint64_t value = 0) : value_(value) {}
  Counter(const Counter& other) : value_(other.value_.load()) {}
  Counter& operator=(const Counter& other) {
    value_ = other.value_.load();
    return *this;
  }
  operator std::uint64_t() const { return value_; }

  Counter& operator+=(std::uint64_t more) {
    value_ += more;
    return *this;
  }
  Counter& operator++() { return *this += 1; }

 private:
  std::atomic<std::uint64_t> value_;
};

/// What the client has counted since start(). The counters never decrease.
struct ClientStatistics {
  Counter connections;          ///< connections that were established
  Counter failed_attempts;      ///< attempts to connect that failed
  Counter stalls;               ///< connections given up because a picture or an answer was due and did not come
  Counter protocol_errors;      ///< connections given up because the peer broke the protocol
  Counter pictures;             ///< good pictures delivered
  Counter corrupt_pictures;     ///< pictures dropped: not a whole baseline JPEG of a size the camera has
  Counter unexpected_pictures;  ///< good pictures dropped: the stream is off (it was just stopped)
  Counter stale_pictures;       ///< good pictures dropped: this process stalled, and they waited unread
  Counter bytes_received;       ///< bytes read from the socket
  Counter telemetry;            ///< telemetry delivered
  Counter thinned_telemetry;    ///< telemetry dropped: it came more than twice as often as requested
  Counter sounds;               ///< pieces of heard sound that were delivered
  Counter sound_gaps;           ///< how often sound was missing between two pieces
  Counter thinned_sounds;       ///< pieces dropped: more than twice as much came as requested
  Counter impossible_values;    ///< values dropped from telemetry or detected colours: no robot can have them
  Counter refusals;             ///< requests that the robot refused

  /// @name Pictures by UDP
  /// @{
  Counter datagrams;            ///< datagrams received from the robot
  Counter lost_datagrams;       ///< datagrams that were missing when a later one came
  Counter reordered_datagrams;  ///< datagrams that came behind later ones: not lost, or a second time
  Counter bad_datagrams;        ///< datagrams that came from the robot's address but were not part of a picture
  Counter foreign_datagrams;    ///< datagrams dropped: they came from another address
  Counter lost_pictures;        ///< pictures of which a datagram was lost or came too late
  /// @}
};

}  // namespace aibo_client

#endif  // AIBO_CLIENT_STATUS_H
