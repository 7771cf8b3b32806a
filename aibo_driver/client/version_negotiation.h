/// @file version_negotiation.h
#ifndef AIBO_DRIVER_CLIENT_VERSION_NEGOTIATION_H
#define AIBO_DRIVER_CLIENT_VERSION_NEGOTIATION_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace aibo_client {

/// Finds out which version of the protocol a server speaks, from its answer to `X`, the request for version 2. It does
/// no I/O and reads no clock.
class VersionNegotiation {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  using Bytes = std::vector<std::uint8_t>;

  /// If a server has not answered after this time, it speaks version 1 (docs/protocol.md).
  static constexpr std::chrono::milliseconds kPatience{500};

  enum class Result {
    kOpen,                ///< no answer yet
    kVersion1,            ///< the server refused version 2
    kVersion1Unanswered,  ///< no answer has come in time, but one may still come
    kVersion2             ///< the server agreed to version 2
  };

  explicit VersionNegotiation(TimePoint asked) : deadline_(asked + kPatience) {}

  /// The request to send first.
  static Bytes request();

  /// Call this when bytes were read, but only while the result is kOpen.
  void bytesArrived(const std::uint8_t* data, std::size_t size);

  /// Call this when deadline() has passed and everything that had arrived until then has been handed in.
  void checkDeadline(TimePoint now);
  TimePoint deadline() const { return deadline_; }

  Result result() const { return result_; }

  /// Bytes that arrived and are not part of the answer. They belong to the session.
  const Bytes& rest() const { return bytes_; }

 private:
  void judge();

  TimePoint deadline_;
  Result result_ = Result::kOpen;
  Bytes bytes_;
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_VERSION_NEGOTIATION_H
