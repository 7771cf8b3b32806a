/// @file request_tap.h
#ifndef TEST_SOAK_REQUEST_TAP_H
#define TEST_SOAK_REQUEST_TAP_H

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>

#include "support/proxy/scanners.h"

namespace soak {

/// Counts the requests that move joints, connection by connection, in what a driver sends: before anything goes wrong
/// with it. Only the newest connection can still send, so the counts of much older ones are forgotten.
///
/// Every function may be called from any thread.
class RequestTap {
 public:
  /// The next bytes that the driver has sent.
  void hear(std::size_t connection, const std::uint8_t* data, std::size_t size);

  /// Requests that move joints, over this connection and later ones; the first is 0.
  std::size_t jointRequestsFrom(std::size_t connection) const;

  /// Connections over which anything was sent so far.
  std::size_t connections() const;

 private:
  struct Connection {
    test_support::RequestScanner scanner;
    std::size_t joint_requests = 0;
  };

  mutable std::mutex mutex_;
  std::map<std::size_t, Connection> connections_;
};

}  // namespace soak

#endif  // TEST_SOAK_REQUEST_TAP_H
