/// @file fault_proxy.h
#ifndef TEST_SUPPORT_PROXY_FAULT_PROXY_H
#define TEST_SUPPORT_PROXY_FAULT_PROXY_H

#include <poll.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <list>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "host_files/file_descriptor.h"
#include "support/proxy/fault.h"
#include "support/proxy/link.h"
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
  explicit FaultProxy(const Options& options);

  /// In front of the server on this port of 127.0.0.1.
  explicit FaultProxy(int target_port);

  ~FaultProxy();

  FaultProxy(const FaultProxy&) = delete;
  FaultProxy& operator=(const FaultProxy&) = delete;

  int port() const { return port_; }

  /// Sets the conditions for present and later connections.
  void setConditions(const Conditions& conditions);

  /// Sets what happens to clients that connect from now on.
  void setWelcome(Welcome welcome);

  /// Adds a fault. Faults take place in the order in which they were added, each over the connection that first reaches
  /// its place. A picture counts if it begins after all earlier faults.
  void add(const Fault& fault);

  /// Ends all connections.
  /// @param end kClose, kReset, kHalfClose or kSilence
  void endConnections(Action end);

  /// Ends all faults: resets silenced connections, removes conditions and faults, and serves clients.
  void heal();

  /// Connections to the server so far.
  std::size_t connections() const;

  /// Faults made so far.
  std::size_t faultsDone() const;

  /// Waits until this many faults have been made since the construction.
  /// @return when the last of them was made; nothing if they were not made in time
  std::optional<TimePoint> waitForFaults(std::size_t count, std::chrono::milliseconds timeout);

 private:
  /// Changes something, and wakes the proxy's thread.
  template <typename Change>
  void change(const Change& apply);
  void receiveClientsBy(Welcome welcome);
  void run();
  TimePoint prepare(std::vector<pollfd>* polled);
  void serve(const std::vector<pollfd>& polled);
  void acceptClients();
  void receiveClient(host_files::FileDescriptor client);

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
