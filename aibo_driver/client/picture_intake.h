/// @file picture_intake.h
#ifndef AIBO_DRIVER_CLIENT_PICTURE_INTAKE_H
#define AIBO_DRIVER_CLIENT_PICTURE_INTAKE_H

#include <chrono>

namespace aibo_driver {

/// Keeps track of whether the server has been told to stream. For a version 1 server that is all there is: one and the
/// same request starts and stops the stream and is never acknowledged, so on or off follows from the number of toggles
/// sent over this connection. A new connection is off.
class StreamControl {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// Pictures of a stopped stream may still be under way for so long after the last one.
  static constexpr std::chrono::milliseconds kDrainTime{200};
  /// A stopped stream that still delivers after this time has not been stopped.
  static constexpr std::chrono::milliseconds kStopTime{1000};

  explicit StreamControl(TimePoint connected) : off_since_(connected), quiet_since_(TimePoint::min()) {}

  bool on() const { return on_; }

  /// Of the pictures, 1..100; 0 = never toggled.
  int quality() const { return quality_; }

  /// A toggle has been sent, with this quality.
  void toggled(int quality, TimePoint now);

  /// The running stream has been told another quality (version 2 only).
  void setQuality(int quality) { quality_ = quality; }

  /// Bytes have come while the stream was off and nobody had asked for a picture.
  void lateBytes(TimePoint now) { quiet_since_ = now; }

  /// When no picture of a stopped stream is to be expected any more, if no more bytes come. From then on a picture can
  /// only be the answer to a request for one.
  TimePoint drainedAt() const;

  /// True if the stream, though stopped, should have ended long ago.
  bool isOverdue(TimePoint now) const { return !on_ && now - off_since_ > kStopTime; }

 private:
  bool on_ = false;
  int quality_ = 0;
  TimePoint off_since_;
  TimePoint quiet_since_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_PICTURE_INTAKE_H
