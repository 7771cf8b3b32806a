/// @file request_tap.h
#ifndef TEST_SOAK_REQUEST_TAP_H
#define TEST_SOAK_REQUEST_TAP_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>

#include "protocol/frame_reader.h"

namespace soak {

/// Listens to what a driver sends over each connection, before anything goes wrong with it, for requests that move
/// joints. Only the newest connection can still send; what older ones sent is forgotten.
class RequestTap {
 public:
  /// The next bytes that the driver has sent. Any thread.
  void hear(std::size_t connection, const std::uint8_t* data, std::size_t size);

  /// Requests that move joints, over connections from this one on, the first is 0. Any thread.
  std::size_t jointRequestsFrom(std::size_t connection) const;

  /// Connections over which anything was sent so far. Any thread.
  std::size_t connections() const;

 private:
  struct Connection {
    std::size_t bytes = 0;
    std::size_t joint_requests = 0;
    std::array<unsigned char, protocol::version2::MAX_PAYLOAD_TOWARDS_ROBOT> payload{};
    protocol::version2::FrameReader frames{payload.data(), payload.size()};
  };

  void hear(Connection* connection, const std::uint8_t* data, std::size_t size);

  mutable std::mutex mutex_;
  std::map<std::size_t, std::unique_ptr<Connection>> connections_;
};

}  // namespace soak

#endif  // TEST_SOAK_REQUEST_TAP_H
