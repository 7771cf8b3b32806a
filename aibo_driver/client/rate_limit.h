/// @file rate_limit.h
#ifndef AIBO_DRIVER_CLIENT_RATE_LIMIT_H
#define AIBO_DRIVER_CLIENT_RATE_LIMIT_H

#include <chrono>
#include <cstddef>
#include <mutex>

namespace aibo_driver {

/// Decides what is let through of something that a robot can send without end. A burst may come at once, in the long
/// run one per period. May be called from any thread.
class RateLimit {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  using Duration = TimePoint::duration;

  struct Admission {
    bool is_admitted;      ///< false: left out
    std::size_t left_out;  ///< since the last one that was admitted, this one included
  };

  /// @param burst how many may come at once, at least 1
  explicit RateLimit(int burst) : burst_(burst), allowed_(burst) {}

  /// @param now not before the last call's
  /// @param period from one to the next in the long run; may differ from call to call. 0: none is allowed again, until
  ///   a call has another period
  Admission admit(TimePoint now, Duration period);

 private:
  const int burst_;
  std::mutex mutex_;
  TimePoint refilled_;  ///< when the last one became allowed
  int allowed_;
  std::size_t left_out_ = 0;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_RATE_LIMIT_H
