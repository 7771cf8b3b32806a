/// @file rcserver_client.h
/// The client of the robot's RCServer. No ROS in it.
#ifndef AIBO_DRIVER_RCSERVER_CLIENT_H
#define AIBO_DRIVER_RCSERVER_CLIENT_H

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "aibo_driver/log.h"
#include "aibo_driver/picture.h"

namespace aibo_driver {

class Transport;

/// How to reach the robot, and how patient to be with it. Checked by the constructor of RcServerClient.
struct ClientOptions {
  std::string host = "127.0.0.1";  ///< name or address of the robot; not empty
  int port = 54321;                ///< 1..65535; the RCServer's port (report, section 2.2)
  int jpeg_quality = 85;           ///< 1..100, of the stream (report, section 3.3.3, gives 85 as the standard)
  std::chrono::milliseconds connect_timeout{2000};     ///< 50 ms..60 s, name lookup included
  std::chrono::milliseconds read_timeout{500};         ///< 50 ms..60 s; a running stream silent for so long is dead
  std::chrono::milliseconds reconnect_wait_min{100};   ///< 10 ms..reconnect_wait_max; doubles with each failure
  std::chrono::milliseconds reconnect_wait_max{2000};  ///< up to 60 s; the longest wait from one attempt to the next
};

enum class ConnectionState { kDisconnected, kConnecting, kConnected };

/// Where the client stands with the robot.
struct ConnectionStatus {
  ConnectionState state = ConnectionState::kDisconnected;
  int protocol_version = 0;  ///< 1 once connected; 0 while not
  std::string reason;        ///< why the last connection or attempt ended; empty when all is well
  std::string advice;        ///< what the user should check; empty when all is well
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
};

/// Keeps one connection to an RCServer, and gets pictures over it.
///
/// A thread of its own connects, reconnects after every fault with growing, jittered waits, and splits the byte
/// stream into pictures and replies. The wish to stream survives reconnects; a request for a single picture does not.
/// All waiting is done on the steady clock and ends at once when stop() is called.
///
/// Every member function may be called from any thread, except where it says otherwise.
class RcServerClient {
 public:
  /// Called on the client's thread with every good picture of the stream, and with those taken by takePicture().
  /// Must not block, and must call neither stop() nor takePicture(): while it runs, nothing is read from the robot.
  /// What it throws is logged.
  using PictureCallback = std::function<void(const PicturePtr& picture)>;
  /// Called on the client's thread each time the connection status changes. Same rules.
  using StatusCallback = std::function<void(const ConnectionStatus& status)>;
  /// Called on the client's thread each time streaming() changes. Same rules.
  using StreamingCallback = std::function<void(bool streaming)>;

  struct Callbacks {
    PictureCallback on_picture;
    StatusCallback on_status;
    StreamingCallback on_streaming;
    LogSink log;
  };

  /// Nothing is connected before start().
  /// @throw InvalidArgumentException if an option is out of its range; the message names it and the range.
  RcServerClient(const ClientOptions& options, Callbacks callbacks);

  /// The same over another transport than TCP: for tests.
  RcServerClient(const ClientOptions& options, Callbacks callbacks, std::unique_ptr<Transport> transport);

  /// Calls stop().
  ~RcServerClient();

  RcServerClient(const RcServerClient&) = delete;
  RcServerClient& operator=(const RcServerClient&) = delete;

  /// Begins to connect. Does nothing if it has begun already.
  /// @throw Exception after stop(): a client that was stopped stays stopped
  void start();

  /// Ends the connection and the thread, within a second in every state; a takePicture() in progress ends with
  /// StoppedException. No callback runs after it has returned. Does nothing the second time.
  void stop() noexcept;

  /// What is wanted: pictures all the time, or none. Takes effect at once when connected, otherwise as soon as a
  /// connection stands, and again after each reconnect. Idempotent: wanting what is wanted already sends nothing.
  void setStreaming(bool on);

  /// The quality of the stream's pictures. Takes effect when the stream is next started; a running stream of a
  /// version 1 server keeps the quality it was started with.
  /// @param quality 1..100
  /// @throw InvalidArgumentException outside of the range
  void setJpegQuality(int quality);

  /// True while a stream has been asked for over the present connection and has not been stopped since.
  bool streaming() const;

  /// Waits for a picture that was taken after this call.
  ///
  /// Without a stream it is one picture of the given quality. During a stream of a version 1 server it is the
  /// stream's next picture, at the stream's quality: such a server must not be sent `F` while it streams.
  ///
  /// A damaged picture is no answer: it is asked for again, as long as the time allows. If the time passes while the
  /// robot owes a picture, the connection is made anew, since nobody could tell which request its next one answers.
  ///
  /// @param quality 0..100; 0 = the stream's quality
  /// @param timeout longest time to wait, 1 ms..1 h
  /// @param[out] from_stream if not null: true if the picture was taken from the running stream
  /// @return the picture, never null
  /// @throw InvalidArgumentException quality or timeout out of range
  /// @throw NetworkException no connection, or it broke while waiting; the message says why and what to check
  /// @throw TimeoutException connected, but no picture came in time
  /// @throw CommandException the robot answered with an error
  /// @throw StoppedException stop() was called
  /// @throw Exception called from a callback
  PicturePtr takePicture(int quality, std::chrono::milliseconds timeout, bool* from_stream = nullptr);

  /// A snapshot of the connection's status.
  ConnectionStatus status() const;

  /// A snapshot of the counters.
  ClientStatistics statistics() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_RCSERVER_CLIENT_H
