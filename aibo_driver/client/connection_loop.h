/// @file connection_loop.h
#ifndef AIBO_DRIVER_CLIENT_CONNECTION_LOOP_H
#define AIBO_DRIVER_CLIENT_CONNECTION_LOOP_H

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "aibo_client/callbacks.h"
#include "aibo_client/options.h"
#include "client/connection.h"
#include "client/fault.h"
#include "client/reconnect_backoff.h"
#include "client/session.h"
#include "client/tcp_transport.h"
#include "client/version1_session.h"

namespace aibo_client {

/// The client's thread. It connects, serves the connection until it ends, and connects again. This class also holds the
/// data that this thread shares with the threads that call RcServerClient.
class ConnectionLoop {
 public:
  /// The data that all threads share. They use it only through read() and change().
  struct Shared {
    bool stopped = false;
    bool streaming = false;  ///< a stream has been requested over the present connection
    Settings wanted;
    ConnectionStatus status;
    MotorsAndPosture motors_and_posture;
    std::vector<std::function<void(Connection&)>> requests;  ///< hand requests to the connection; not called yet
    SoundPart sound;           ///< the next part of the newest sound; if is_last is true, the sound is complete
    std::uint64_t sounds = 0;  ///< how many sounds have begun
    std::thread::id thread;    ///< the client's thread
  };

  ConnectionLoop(const ClientOptions& options, Callbacks callbacks, std::unique_ptr<TcpTransport> transport);

  // These functions do the work of those of RcServerClient:
  void start();
  void waitForConnection(std::chrono::milliseconds timeout) const;
  void stop() noexcept;

  ClientStatistics statistics() const { return counters_; }

  /// Calls `read` with the shared state.
  /// @return what `read` returns
  template <typename Read>
  auto read(const Read& read) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return read(shared_);
  }

  ConnectionStatus status() const {
    return read([](const Shared& shared) { return shared.status; });
  }

  /// Lets `change` change the shared state, and makes the client's thread look at it.
  template <typename Change>
  void change(const Change& change) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      change(shared_);
    }
    has_news_ = true;
    transport_->wakeUp();
  }

  /// Call this only within change() or read().
  /// @throw NetworkException there is no connection
  /// @throw StoppedException stop() was called
  void requireConnection(const Shared& shared) const;

  /// Call this in functions that wait for the client's thread.
  /// @throw Exception this is that thread: the function was called from a callback
  static void requireOtherThread(const Shared& shared);

  const std::string& address() const { return address_; }

 private:
  // Everything below runs on the client's thread.

  void run();
  void connectAndServe();
  void beginSession();
  Session::Bytes askForVersion2();
  void pauseUntil(TimePoint end);
  void talk();
  void send(const Session::Bytes& bytes) { transport_->send(bytes.data(), bytes.size()); }
  void takeNews();
  int datagramPort(const Settings& wanted);
  void listen();
  bool takeDatagrams();
  void report();
  void onReady();
  void onFault(const Fault& cause);
  bool wasTurnedAway(const Fault& fault) const;
  void endConnection(const std::string& reason, const std::string& advice, FaultKind kind);
  template <typename Value, typename Argument>
  void update(Value Shared::*member, const Value& value, std::function<void(Argument)> Callbacks::*callback,
              const char* name);
  void publish(const ConnectionStatus& status);
  /// True from the end of a successful attempt to connect to the end of the connection.
  bool established() const { return connected_ != TimePoint::max(); }
  bool isStopped() const;

  const ClientOptions options_;
  const std::string address_;  // "host:port"
  const Notifier notifier_;
  const std::unique_ptr<TcpTransport> transport_;
  ClientStatistics counters_;

  std::mutex lifecycle_mutex_;  // makes start() and stop() wait for each other
  std::thread thread_;          // guarded by lifecycle_mutex_

  mutable std::mutex mutex_;
  Shared shared_;  // guarded by mutex_
  mutable std::condition_variable connected_or_stopped_;
  std::atomic<bool> has_news_{true};  // shared_ may hold something that the client's thread has not seen yet

  // Members that only the client's thread uses.
  Settings wanted_;  // the user's settings as last seen
  std::optional<Connection> connection_;
  std::unique_ptr<Session> session_;        // null until the version of the protocol is known
  TimePoint connected_ = TimePoint::max();  // when the connection was made; max without one
  bool heard_ = false;                      // the server has sent something
  TimePoint attempt_began_;                 // when the present or last attempt to connect began
  TimePoint next_attempt_;
  ReconnectBackoff backoff_;
  std::set<FaultKind> logged_faults_;  // faults since the last connection that worked
  std::string went_off_;               // why the robot went off, in its words, unless it has answered since
  std::array<std::uint8_t, 64 * 1024> buffer_;
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_CONNECTION_LOOP_H
