/// @file connection_loop.h
#ifndef AIBO_DRIVER_CLIENT_CONNECTION_LOOP_H
#define AIBO_DRIVER_CLIENT_CONNECTION_LOOP_H

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "aibo_driver/rcserver_client.h"
#include "client/connection.h"
#include "client/fault.h"
#include "client/reconnect_backoff.h"
#include "client/session.h"
#include "client/tcp_transport.h"
#include "client/version1_session.h"
#include "client/version_negotiation.h"

namespace aibo_driver {

/// The client's thread: it connects, serves the connection until it ends, and connects again; and what this thread
/// shares with those that call the functions of RcServerClient.
class ConnectionLoop {
 public:
  /// Used by any thread, through read() and change() only.
  struct Shared {
    bool stopped = false;
    bool streaming = false;  ///< a stream has been requested over the present connection
    Wish wish;
    ConnectionStatus status;
    MotorsAndPosture motors_and_posture;
    std::vector<Call> calls;  ///< that the client's thread has not taken over yet
    CommandOutbox commands;   ///< the same
    std::thread::id thread;   ///< the client's
  };

  ConnectionLoop(const ClientOptions& options, RcServerClient::Callbacks callbacks,
                 std::unique_ptr<TcpTransport> transport);

  // The functions of RcServerClient:
  void start();
  void stop() noexcept;

  ClientStatistics statistics() const { return counters_.snapshot(); }

  /// @return what `read` returns, which is given the shared state
  template <typename Read>
  auto read(const Read& read) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return read(shared_);
  }

  /// Lets `change` change the shared state, and has the client's thread look at it.
  template <typename Change>
  void change(const Change& change) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      change(shared_);
    }
    has_news_ = true;
    transport_->wakeUp();
  }

  /// To be called within change() or read().
  /// @throw NetworkException there is no connection
  /// @throw StoppedException stop() was called
  void requireConnection(const Shared& shared) const;

  const std::string& address() const { return address_; }

 private:
  // All that follows runs on the client's thread.

  void run();
  void connectAndServe();
  void beginSession();
  VersionNegotiation negotiate();
  void beginVersion1(Version1Session::VersionAnswer answer);
  void pauseUntil(TimePoint end);
  void talk();
  void send(const Session::Bytes& bytes) { transport_->send(bytes.data(), bytes.size()); }
  void takeNews(TimePoint now);
  int datagramPort(const Wish& wish);
  void listen();
  bool takeDatagrams(TimePoint now);
  void reportSession();
  void onReady();
  void onFault(const Fault& cause);
  bool wasTurnedAway(const Fault& fault) const;
  void endConnection(CallOutcome outcome, const std::string& reason, const std::string& advice, FaultKind kind);
  void updateStreaming(bool streaming);
  void updateMotorsAndPosture(const MotorsAndPosture& state);
  template <typename Change>
  void updateStatus(const Change& change);
  /// True from the end of a successful attempt to connect to the end of the connection.
  bool established() const { return connected_ != TimePoint::max(); }
  bool isStopped() const;

  const ClientOptions options_;
  const std::string address_;  // "host:port"
  const Notifier notifier_;
  const std::unique_ptr<TcpTransport> transport_;
  Counters counters_;

  std::mutex lifecycle_mutex_;  // makes start() and stop() wait for each other
  std::thread thread_;          // guarded by lifecycle_mutex_

  mutable std::mutex mutex_;
  Shared shared_;                     // guarded by mutex_
  std::atomic<bool> has_news_{true};  // shared_ may hold something that the client's thread has not seen yet

  // Used by the client's thread alone.
  Wish wish_;  // as last seen
  std::optional<Connection> connection_;
  std::unique_ptr<Session> session_;  // there once the version of the protocol is clear
  ServerHabits habits_;
  unsigned transport_changes_ = 0;          // of the user's that have been obeyed
  std::string datagrams_blocked_;           // why no datagram has ever come; empty if any has, or none was due
  TimePoint connected_ = TimePoint::max();  // since when; max if not
  bool heard_ = false;                      // the server has sent something
  TimePoint attempt_began_;                 // the present or last attempt to connect
  TimePoint next_attempt_;
  ReconnectBackoff backoff_;
  std::set<FaultKind> logged_faults_;  // since the last connection that worked
  std::array<std::uint8_t, 64 * 1024> buffer_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_CONNECTION_LOOP_H
