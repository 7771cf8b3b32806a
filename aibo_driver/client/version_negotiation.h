/// @file version_negotiation.h
#ifndef AIBO_DRIVER_CLIENT_VERSION_NEGOTIATION_H
#define AIBO_DRIVER_CLIENT_VERSION_NEGOTIATION_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace aibo_driver {

/// Finds out which version of the protocol a server speaks, from its answer to `X`, the request for version 2. It does
/// no I/O and reads no clock.
class VersionNegotiation {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  using Bytes = std::vector<std::uint8_t>;

  /// A server that has not answered after this time speaks version 1 (docs/protocol.md).
  static constexpr std::chrono::milliseconds kPatience{500};

  enum class Result {
    kOpen,                ///< no answer yet
    kVersion1,            ///< the server refused version 2
    kVersion1Unanswered,  ///< no answer; one may still come
    kVersion2             ///< the server agreed to version 2
  };

  explicit VersionNegotiation(TimePoint asked) : deadline_(asked + kPatience) {}

  /// What to send first.
  static Bytes request();

  /// Bytes were read. Only while open.
  void bytesArrived(const std::uint8_t* data, std::size_t size);

  /// To be called when deadline() has passed and what had arrived until then has been handed in.
  void checkDeadline(TimePoint now);
  TimePoint deadline() const { return deadline_; }

  Result result() const { return result_; }

  /// Bytes that arrived and are not part of the answer: they belong to the session.
  const Bytes& rest() const { return bytes_; }

 private:
  void judge();

  TimePoint deadline_;
  Result result_ = Result::kOpen;
  Bytes bytes_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_VERSION_NEGOTIATION_H
