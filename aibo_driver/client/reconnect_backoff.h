/// @file reconnect_backoff.h
#ifndef AIBO_DRIVER_CLIENT_RECONNECT_BACKOFF_H
#define AIBO_DRIVER_CLIENT_RECONNECT_BACKOFF_H

#include <chrono>
#include <random>

namespace aibo_driver {

/// How long to wait before the next attempt to connect: twice as long after each failure, up to a limit; and a random
/// half of it less, so that clients which lost the same robot do not all come back in the same instant.
class ReconnectBackoff {
 public:
  ReconnectBackoff(std::chrono::milliseconds shortest, std::chrono::milliseconds longest, unsigned seed);

  /// The wait before the next attempt: between the half and the whole of a time that begins at `shortest`, doubles with
  /// each call, and never exceeds `longest`.
  std::chrono::milliseconds next();

  /// A connection has worked: begins at `shortest` again.
  void reset();

 private:
  std::chrono::milliseconds shortest_;
  std::chrono::milliseconds longest_;
  std::chrono::milliseconds current_;
  std::minstd_rand random_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_RECONNECT_BACKOFF_H
