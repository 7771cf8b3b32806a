/// @file reconnect_backoff.h
#ifndef AIBO_DRIVER_CLIENT_RECONNECT_BACKOFF_H
#define AIBO_DRIVER_CLIENT_RECONNECT_BACKOFF_H

#include <algorithm>
#include <chrono>
#include <random>

namespace aibo_client {

/// How long to wait before the next attempt to connect. The wait doubles with each failure, up to a limit. A random
/// part of at most half is subtracted, so that clients that lost the same robot do not all return at once.
class ReconnectBackoff {
 public:
  using milliseconds = std::chrono::milliseconds;

  ReconnectBackoff(milliseconds shortest, milliseconds longest, unsigned seed)
      : shortest_(shortest), longest_(longest), current_(shortest), random_(seed) {}

  /// The wait before the next attempt. It is between half and all of a time that begins at `shortest`, doubles with
  /// each call, and never exceeds `longest`.
  milliseconds next() {
    const milliseconds whole = current_;
    current_ = std::min(2 * current_, longest_);
    std::uniform_int_distribution<milliseconds::rep> part(whole.count() / 2, whole.count());
    return milliseconds(part(random_));
  }

  /// Call this when a connection has worked. The next wait begins at `shortest` again.
  void reset() { current_ = shortest_; }

 private:
  milliseconds shortest_;
  milliseconds longest_;
  milliseconds current_;
  std::minstd_rand random_;
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_RECONNECT_BACKOFF_H
