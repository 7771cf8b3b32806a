/// @file fault_proxy.h
#ifndef TEST_SUPPORT_PROXY_FAULT_PROXY_H
#define TEST_SUPPORT_PROXY_FAULT_PROXY_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "support/proxy/fault.h"
#include "support/proxy/pipe.h"

namespace fault_bench {

/// Stands between clients and a server, passes every byte on, and makes go wrong what it is told to. Any number of
/// connections. Random things follow from the seed and from the bytes that come.
///
/// Every function may be called from any thread.
class FaultProxy {
 public:
  /// Called on the proxy's thread with what one side has sent, before it is passed on.
  using Tap =
      std::function<void(std::size_t connection, Direction direction, const std::uint8_t* data, std::size_t size)>;

  struct Options {
    std::string target_host = "127.0.0.1";  ///< the server's IPv4 address
    int target_port = 0;
    std::string address = "127.0.0.1";  ///< IPv4 address of this computer that clients connect to
    int port = 0;                       ///< for clients; 0 = any free one
    unsigned seed = 1;
    Tap tap = nullptr;
  };

  /// Begins to serve.
  /// @throw std::system_error the port cannot be listened on
  explicit FaultProxy(const Options& options);
  ~FaultProxy();

  FaultProxy(const FaultProxy&) = delete;
  FaultProxy& operator=(const FaultProxy&) = delete;

  int port() const;

  /// What the way is like from now on, for connections that are there and for later ones.
  void setConditions(const Conditions& conditions);

  /// How clients are received from now on.
  void setWelcome(Welcome welcome);

  /// Adds a fault. Faults take place one after the other, in the order in which they were added, each over whichever
  /// connection gets there first. A picture counts if it begins after the fault's turn has come.
  void add(const Fault& fault);

  /// Forgets faults that have not taken place.
  void clearFaults();

  /// Ends all connections.
  /// @param end kClose, kReset, kHalfClose or kSilence
  void endConnections(Action end);

  /// All is well from now on: ends connections that have been silenced, forgets conditions and faults, and serves.
  void heal();

  /// The server has moved: later connections go there.
  void setTarget(const std::string& host, int port);

  /// The proxy itself moves to another address of this computer, on the same port. Who is connected hears nothing more.
  /// @throw std::system_error the port is taken there
  void moveTo(const std::string& address);

  /// Connections made with the server so far.
  std::size_t connections() const;

  /// Faults that have taken place so far.
  std::size_t faultsDone() const;

  /// Waits for so many faults to have taken place since the proxy began.
  /// @return the last of them; nothing if the time has passed
  std::optional<FaultReport> waitForFaults(std::size_t count, std::chrono::milliseconds timeout);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace fault_bench

#endif  // TEST_SUPPORT_PROXY_FAULT_PROXY_H
