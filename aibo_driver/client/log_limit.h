/// @file log_limit.h
#ifndef AIBO_DRIVER_CLIENT_LOG_LIMIT_H
#define AIBO_DRIVER_CLIENT_LOG_LIMIT_H

#include <chrono>
#include <cstddef>
#include <mutex>

namespace aibo_driver {

/// Decides which messages are logged, so that a robot cannot fill the disk with what it sends. kBurst messages may come
/// at once, in the long run one per kPeriod. May be called from any thread.
class LogLimit {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  static constexpr int kBurst = 20;
  static constexpr std::chrono::seconds kPeriod{1};

  struct Admission {
    bool is_logged;        ///< false: the message is left out
    std::size_t left_out;  ///< since the last one that was logged, this one included
  };

  /// @param now not before the last call's
  Admission admit(TimePoint now);

 private:
  std::mutex mutex_;
  TimePoint refilled_;  ///< when the last message became allowed
  int allowed_ = kBurst;
  std::size_t left_out_ = 0;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_LOG_LIMIT_H
