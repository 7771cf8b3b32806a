/// @file fault_proxy.h
#ifndef TEST_SUPPORT_PROXY_FAULT_PROXY_H
#define TEST_SUPPORT_PROXY_FAULT_PROXY_H

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <list>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "host_files/file_descriptor.h"
#include "support/proxy/link.h"
#include "support/sockets.h"
#include "system/event.h"

namespace test_support {

/// A proxy between any number of clients and a server, which passes every byte on and makes the faults that it is asked
/// for. All random choices follow from the bytes that come.
///
/// Every function may be called from any thread.
class FaultProxy {
 public:
  /// Begins to serve.
  /// @param target_port of the server, on 127.0.0.1
  explicit FaultProxy(int target_port, Tap tap = nullptr)
      : target_port_(target_port), tap_(std::move(tap)), listener_(bindTo("127.0.0.1", 0)), port_(portOf(listener_)) {
    listener_ = bindTo("127.0.0.1", port_);  // only an explicitly bound port stays reserved while nobody listens
    check(::listen(listener_.get(), SOMAXCONN) == 0, "listen");
    thread_ = std::thread([this] { run(); });
  }

  ~FaultProxy() {
    stopping_ = true;
    wake_up_.raise();
    thread_.join();
  }

  FaultProxy(const FaultProxy&) = delete;
  FaultProxy& operator=(const FaultProxy&) = delete;

  int port() const { return port_; }

  /// Sets the conditions for present and later connections.
  void setConditions(const Conditions& conditions) {
    change([&] { conditions_ = conditions; });
  }

  /// Sets what happens to clients that connect from now on.
  void setWelcome(Welcome welcome) {
    change([&] { receiveClientsBy(welcome); });
  }

  /// Adds a fault. Faults take place in the order in which they were added, each over the connection that first reaches
  /// its place. A picture counts if it begins after all earlier faults.
  void add(const Fault& fault) {
    change([&] { faults_.faults.push_back(fault); });
  }

  /// Ends all connections.
  /// @param end kClose, kReset, kHalfClose or kSilence
  void endConnections(Action end) {
    change([&] {
      for (Link& link : links_) {
        link.end(end, Direction::kToClient);
      }
      held_.clear();
    });
  }

  /// Ends all faults: resets silenced connections, removes conditions and faults, and serves clients.
  void heal() {
    change([&] {
      conditions_ = Conditions();
      faults_.faults.clear();
      ++faults_.turn;
      held_.clear();
      for (Link& link : links_) {
        if (link.isSilent()) {
          link.end(Action::kReset, Direction::kToClient);
        }
      }
      receiveClientsBy(Welcome::kServe);
    });
  }

  /// Connections to the server so far.
  std::size_t connections() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return connections_;
  }

  /// Faults made so far.
  std::size_t faultsDone() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return faults_done_;
  }

  /// Waits until this many faults have been made since the construction.
  /// @return when the last of them was made; nothing if they were not made in time
  std::optional<TimePoint> waitForFaults(std::size_t count, std::chrono::milliseconds timeout) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!fault_done_.wait_for(lock, timeout, [&] { return faults_done_ >= count; })) {
      return std::nullopt;
    }
    return last_fault_;
  }

 private:
  /// Changes something, and wakes the proxy's thread.
  template <typename Change>
  void change(const Change& apply) {
    const std::lock_guard<std::mutex> lock(mutex_);
    apply();
    wake_up_.raise();
  }

  void receiveClientsBy(Welcome welcome) {
    if (welcome == Welcome::kRefuse && welcome_ != Welcome::kRefuse) {
      ::shutdown(listener_.get(), SHUT_RDWR);  // stops listening, and the port stays reserved
    } else if (welcome != Welcome::kRefuse && welcome_ == Welcome::kRefuse) {
      check(::listen(listener_.get(), SOMAXCONN) == 0, "listen");
    }
    welcome_ = welcome;
  }

  void run() {
    while (!stopping_) {
      std::vector<pollfd> polled = {{wake_up_.descriptor(), POLLIN, 0}};
      const TimePoint end = prepare(&polled);
      pollUntil(&polled, end);
      wake_up_.clear();
      serve();
    }
  }

  TimePoint prepare(std::vector<pollfd>* polled) {
    const std::lock_guard<std::mutex> lock(mutex_);
    polled->push_back({welcome_ == Welcome::kRefuse ? -1 : listener_.get(), POLLIN, 0});
    bool is_busy = false;
    for (const Link& link : links_) {
      is_busy = link.prepare(conditions_, polled) || is_busy;
    }
    return std::chrono::steady_clock::now() + std::chrono::milliseconds(is_busy ? 1 : 1000);
  }

  void serve() {
    const std::lock_guard<std::mutex> lock(mutex_);
    const TimePoint now = std::chrono::steady_clock::now();
    std::size_t done = 0;
    for (Link& link : links_) {
      done += link.isOver() ? 0 : link.serve(now, conditions_, &faults_, tap_);
    }
    links_.remove_if([](const Link& link) { return link.isOver(); });
    if (done > 0) {
      faults_done_ += done;
      last_fault_ = now;
      fault_done_.notify_all();
    }
    acceptClients();
  }

  void acceptClients() {
    while (welcome_ != Welcome::kRefuse) {
      host_files::FileDescriptor client = acceptFrom(listener_);
      if (!client.valid()) {
        return;
      }
      receiveClient(std::move(client));
    }
  }

  void receiveClient(host_files::FileDescriptor client) {
    switch (welcome_) {
      case Welcome::kReset:
        resetWhenClosed(client);
        break;
      case Welcome::kSilence:
        held_.push_back(std::move(client));
        break;
      case Welcome::kServe:
        try {
          links_.emplace_back(connections_, std::move(client), beginConnecting("127.0.0.1", target_port_));
          ++connections_;
        } catch (const std::system_error&) {
          // The server is unreachable: the client is turned away.
        }
        break;
      default:
        break;
    }
  }

  mutable std::mutex mutex_;  // guards what follows, down to the thread
  const int target_port_;
  const Tap tap_;
  host_files::FileDescriptor listener_;
  const int port_;
  Welcome welcome_ = Welcome::kServe;
  Conditions conditions_;
  FaultQueue faults_;
  std::list<Link> links_;
  std::vector<host_files::FileDescriptor> held_;  // clients that hear nothing
  std::size_t connections_ = 0;
  std::size_t faults_done_ = 0;
  TimePoint last_fault_;
  std::condition_variable fault_done_;
  aibo_system::Event wake_up_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_PROXY_FAULT_PROXY_H
