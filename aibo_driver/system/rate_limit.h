/// @file rate_limit.h
#ifndef AIBO_DRIVER_SYSTEM_RATE_LIMIT_H
#define AIBO_DRIVER_SYSTEM_RATE_LIMIT_H

#include <chrono>
#include <cstddef>
#include <mutex>

namespace aibo_system {

/// Limits something that a robot can send endlessly. A burst may come at once but, in the long run, one item per period
/// is admitted. Any thread may call it.
class RateLimit {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  using Duration = TimePoint::duration;

  struct Admission {
    bool is_admitted;      ///< false means left out
    std::size_t left_out;  ///< how many were left out since the last admitted one, including this one
  };

  /// @param burst how many may come at once, at least 1
  explicit RateLimit(int burst) : burst_(burst), allowed_(burst) {}

  /// @param now not earlier than in the last call
  /// @param period the time between two in the long run; it may differ from call to call. 0 means that none is admitted
  ///   until a call has another period
  /// @param count how many come at once, at least 1. All of them are admitted, or none. A count
  ///   above the burst is never admitted
  Admission admit(TimePoint now, Duration period, int count = 1);

 private:
  const int burst_;
  std::mutex mutex_;
  TimePoint refilled_;  ///< when allowed_ was last raised
  int allowed_;
  std::size_t left_out_ = 0;
};

}  // namespace aibo_system

#endif  // AIBO_DRIVER_SYSTEM_RATE_LIMIT_H
