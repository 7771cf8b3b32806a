/// @file stall_detector.h
#ifndef AIBO_DRIVER_CLIENT_STALL_DETECTOR_H
#define AIBO_DRIVER_CLIENT_STALL_DETECTOR_H

#include <chrono>

namespace aibo_client {

/// Notices that the client's own thread has not kept up with a stream, and which pictures are stale because of that.
///
/// While the thread keeps up, it finds the socket empty many times a second. If it has not found it empty for
/// kStallLimit, pictures of unknown age have piled up in the kernels of both computers (measured: up to 5 s old after a
/// pause of 5 s). All of them are stale until the socket has stayed empty for kQuietTime. That is longer than the robot
/// takes to refill a freed window, and shorter than the pause between two camera images (32 ms less the transfer of a
/// picture).
class StallDetector {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  static constexpr std::chrono::milliseconds kStallLimit{100};
  static constexpr std::chrono::milliseconds kQuietTime{15};
  /// After this time everything that had piled up has been read, even if the socket was never empty.
  static constexpr std::chrono::milliseconds kCatchUpLimit{500};

  explicit StallDetector(TimePoint now) : fresh_since_(now), last_empty_(now) {}

  /// The stream begins, and the socket is empty.
  void restart(TimePoint now) { *this = StallDetector(now); }

  /// Call this when bytes were read.
  void bytesArrived(TimePoint now) {
    last_bytes_ = now;
    if (!catching_up_ && now - last_empty_ > kStallLimit) {
      catching_up_ = true;
      catching_up_since_ = now;
    } else if (catching_up_ && now - catching_up_since_ > kCatchUpLimit) {
      restart(now);
    }
  }

  /// Call this when nothing was left to read.
  void foundEmpty(TimePoint now) {
    last_empty_ = now;
    if (catching_up_ && now - last_bytes_ >= kQuietTime) {
      catching_up_ = false;
      fresh_since_ = now;
    }
  }

  /// The latest time to look at the socket again.
  TimePoint nextLook() const { return catching_up_ ? last_bytes_ + kQuietTime : last_empty_ + kStallLimit / 2; }

  /// True for a picture of the stream that may have waited for a long time.
  /// @param first_byte_time when the picture's first byte was read
  bool isStale(TimePoint first_byte_time) const { return catching_up_ || first_byte_time < fresh_since_; }

 private:
  bool catching_up_ = false;
  TimePoint catching_up_since_;
  TimePoint fresh_since_;
  TimePoint last_empty_;
  TimePoint last_bytes_;
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_STALL_DETECTOR_H
