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
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "host_files/file_descriptor.h"
#include "support/proxy/fault.h"
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
  struct Options {
    std::string target_host = "127.0.0.1";  ///< the server's IPv4 address
    int target_port = 0;
    int port = 0;  ///< for clients, on 127.0.0.1; 0 = any free one
    Tap tap = nullptr;
  };

  /// Begins to serve.
  /// @throw std::system_error the port cannot be listened on
  explicit FaultProxy(const Options& options) : options_(options), listener_(bindTo("127.0.0.1", options.port)) {
    port_ = portOf(listener_);
    listener_ = bindTo("127.0.0.1", port_);  // only an explicitly bound port stays reserved while nobody listens
    check(::listen(listener_.get(), SOMAXCONN) == 0, "listen");
    thread_ = std::thread([this] { run(); });
  }

  /// In front of the server on this port of 127.0.0.1.
  explicit FaultProxy(int target_port) : FaultProxy(Options{"127.0.0.1", target_port}) {}

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
    change([&] { faults_.add(fault); });
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
      faults_.clear();
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
    std::vector<pollfd> polled;
    while (!stopping_) {
      polled.clear();
      pollUntil(&polled, prepare(&polled));
      if (polled[0].revents != 0) {
        wake_up_.clear();
      }
      serve(polled);
    }
  }

  TimePoint prepare(std::vector<pollfd>* polled) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const TimePoint now = std::chrono::steady_clock::now();
    TimePoint next = TimePoint::max();
    polled->push_back({wake_up_.descriptor(), POLLIN, 0});
    polled->push_back({welcome_ == Welcome::kRefuse ? -1 : listener_.get(), POLLIN, 0});
    for (Link& link : links_) {
      const auto interests = link.interests(now, conditions_);
      polled->insert(polled->end(), interests.begin(), interests.end());
      next = std::min(next, link.nextDue());
    }
    polled_links_ = links_.size();
    return next == TimePoint::max() ? now + std::chrono::seconds(1) : next;
  }

  void serve(const std::vector<pollfd>& polled) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const TimePoint now = std::chrono::steady_clock::now();
    std::size_t done = 0;
    std::size_t entry = 2;
    for (auto link = links_.begin(); link != links_.end() && entry < 2 + 2 * polled_links_; ++link, entry += 2) {
      if (!link->isOver()) {
        done += link->serve({{polled[entry], polled[entry + 1]}}, now, conditions_, &faults_, options_.tap);
      }
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
          links_.emplace_back(connections_, std::move(client),
                              beginConnecting(options_.target_host, options_.target_port));
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
  Options options_;
  host_files::FileDescriptor listener_;
  int port_ = 0;
  Welcome welcome_ = Welcome::kServe;
  Conditions conditions_;
  FaultQueue faults_;
  std::list<Link> links_;
  std::size_t polled_links_ = 0;                  // how many of links_ the thread waits for
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
