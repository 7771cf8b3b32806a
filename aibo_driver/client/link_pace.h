/// @file link_pace.h
#ifndef AIBO_DRIVER_CLIENT_LINK_PACE_H
#define AIBO_DRIVER_CLIENT_LINK_PACE_H

#include <chrono>
#include <cstddef>
#include <cstdint>

#include "protocol/picture_datagram.h"

namespace aibo_client {

/// Measures how fast the link carries datagrams, and whether it has time left between pictures.
class LinkPace {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  using Duration = TimePoint::duration;

  /// Call this when a datagram has come.
  void arrived(const protocol::version2::PictureDatagram& datagram, TimePoint now) {
    const bool begins_picture = datagram.picture > picture_;
    if (datagram.sequence == sequence_ + 1 && datagram.picture == picture_) {
      average(&spacing_, now - last_);
    }
    if (begins_picture) {
      if (picture_ >= 0 && datagram.picture == picture_ + 1) {
        const Duration interval = now - began_;
        interval_ =
            interval_ == Duration::zero() || interval < interval_ ? interval : interval_ + (interval - interval_) / 64;
      }
      began_ = now;
      picture_ = datagram.picture;
    }
    last_ = now;
    sequence_ = datagram.sequence;
  }

  /// The mean time between two datagrams of a picture. It is 0 until it is known.
  Duration spacing() const { return spacing_; }

  /// Nearly the shortest time between the beginnings of two pictures. It is 0 until it is known.
  Duration interval() const { return interval_; }

  /// True if a picture of this many parts could have a parity and a repeated part without delaying the next picture.
  bool hasTimeForParity(std::size_t parts) const {
    return interval_ > spacing_ * static_cast<Duration::rep>(parts + 2);
  }

 private:
  /// Updates a moving mean, in which the last eleven values have half of the weight.
  static void average(Duration* mean, Duration value) {
    *mean = *mean == Duration::zero() ? value : *mean + (value - *mean) / 16;
  }

  std::int64_t sequence_ = -1;
  std::int64_t picture_ = -1;
  TimePoint last_;
  TimePoint began_;
  Duration spacing_{0};
  Duration interval_{0};  // the shortest, because a link that is too slow makes the intervals longer
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_LINK_PACE_H
