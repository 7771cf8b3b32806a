/// @file receipt_clock.h
#ifndef AIBO_DRIVER_SYSTEM_RECEIPT_CLOCK_H
#define AIBO_DRIVER_SYSTEM_RECEIPT_CLOCK_H

#include <chrono>
#include <mutex>
#include <optional>

namespace aibo_system {

/// Knows when messages and calls came. If a process stalls, it reads the messages that have come meanwhile only
/// afterwards. Such a message may have come right after the last sign of life, so we assume that it did. Any thread may
/// call any function.
class ReceiptClock {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// The greatest gap between two signs of life without a stall. It is five times what roscpp's thread sleeps at most
  /// (ros::PollManager), because a busy computer lets that thread wait, too.
  static constexpr std::chrono::milliseconds kLongestGap{500};
  /// The time after a longer gap within which all that has waited is read.
  static constexpr std::chrono::milliseconds kCatchingUp{200};

  /// Notes a sign of life of the thread that reads messages. After the first one, the next is expected within
  /// kLongestGap.
  void alive(TimePoint now);

  /// The time when something that is read now came, or the earliest possible time if that is not known. Before the
  /// first sign of life, the result is `now`.
  TimePoint receipt(TimePoint now);

 private:
  void noteLife(TimePoint now);

  std::mutex mutex_;
  std::optional<TimePoint> last_;  ///< the last sign of life
  TimePoint before_gap_;           ///< the last sign of life before the process stalled
  TimePoint caught_up_;            ///< messages that are read before this time may be old
};

}  // namespace aibo_system

#endif  // AIBO_DRIVER_SYSTEM_RECEIPT_CLOCK_H
