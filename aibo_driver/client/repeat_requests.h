/// @file repeat_requests.h
#ifndef AIBO_DRIVER_CLIENT_REPEAT_REQUESTS_H
#define AIBO_DRIVER_CLIENT_REPEAT_REQUESTS_H

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>

#include "client/picture_assembly.h"
#include "protocol/picture_datagram.h"

namespace aibo_client {

/// Decides when to send the robot a status: which pictures are complete and which parts are missing. A new status is
/// sent at once. If nothing comes after it, the robot's datagrams or the status were lost, and the status is repeated a
/// few times, at growing intervals.
class RepeatRequests {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  using Duration = TimePoint::duration;
  using Status = protocol::version2::DatagramStatus;

  /// How often a status is repeated.
  static constexpr int kMostAttempts = 4;
  /// If no part is missing, the next datagram belongs to the next picture. A camera needs up to 40 ms for it.
  static constexpr std::chrono::milliseconds kPictureInterval{50};
  /// If a part is missing, the next datagram is due after the time for kDatagrams, but not before kShortest. The radio
  /// itself takes a few milliseconds to repeat what it has lost.
  static constexpr int kDatagrams = 3;
  static constexpr std::chrono::milliseconds kShortest{8};

  /// Call this when a datagram has come.
  void arrived(TimePoint now) {
    last_ = now;
    attempts_ = 0;
  }

  /// The status to send now. It is empty if there is none.
  /// @param spacing the usual time between two datagrams
  std::optional<Status> next(const PictureAssembly& assembly, Duration spacing, TimePoint now) {
    const bool is_overdue = now >= deadline(assembly, spacing);
    const Status status = assembly.status(is_overdue);
    if (!is_overdue && !isNew(status)) {
      return std::nullopt;
    }
    attempts_ += is_overdue ? 1 : 0;
    last_ = now;
    told_ = status;
    return status;
  }

  /// When to repeat the status if nothing comes until then.
  /// @param spacing 0 if it is not known
  TimePoint deadline(const PictureAssembly& assembly, Duration spacing) const {
    if (last_ == TimePoint() || attempts_ >= kMostAttempts) {
      return TimePoint::max();
    }
    const bool is_due = assembly.isIncomplete() && spacing != Duration::zero();
    const Duration wait = is_due ? std::max<Duration>(kShortest, kDatagrams * spacing) : Duration(kPictureInterval);
    return last_ + std::min<Duration>(wait, kPictureInterval) * (1 << attempts_);
  }

 private:
  bool isNew(const Status& status) const {
    return status.picture != told_.picture || (partsIn(status) & ~partsIn(told_)) != 0;
  }

  /// The parts that the status asks for. Only the first 64 parts of a picture have bits of their own.
  static std::uint64_t partsIn(const Status& status) {
    return status.first_part < 64 ? std::uint64_t{status.missing} << status.first_part : status.missing;
  }

  TimePoint last_;  // when a datagram last came or a status was sent
  int attempts_ = 0;
  Status told_ = {};
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_REPEAT_REQUESTS_H
