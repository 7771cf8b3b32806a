/// @file clock.h
/// The machine's time, in OPEN-R frames of 8 ms; frame 0 is when the clock was made (report, section 2.1.1).
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CLOCK_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CLOCK_H

#include <OPENR/OPENR.h>

#include <chrono>
#include <optional>

namespace openr_host {

constexpr std::chrono::milliseconds kFramePeriod{8};
constexpr double kFrameSeconds = 0.008;

class Clock {
 public:
  virtual ~Clock() = default;

  /// Time since the clock was made.
  virtual std::chrono::nanoseconds now() const = 0;

  /// The steady clock's time when this one shows `since_begin`; empty if only the caller of SteppedClock::step() knows.
  virtual std::optional<std::chrono::steady_clock::time_point> timeOf(std::chrono::nanoseconds since_begin) const = 0;

  /// The present frame.
  longword frame() const { return static_cast<longword>(now() / kFramePeriod); }

  /// When a frame begins, as timeOf().
  std::optional<std::chrono::steady_clock::time_point> beginOf(longword frame) const {
    return timeOf(frame * std::chrono::nanoseconds(kFramePeriod));
  }
};

/// Goes with the steady clock: every frame's begin is counted from frame 0, so that nothing drifts.
class WallClock : public Clock {
 public:
  std::chrono::nanoseconds now() const override { return std::chrono::steady_clock::now() - begin_; }
  std::optional<std::chrono::steady_clock::time_point> timeOf(std::chrono::nanoseconds since_begin) const override {
    return begin_ + since_begin;
  }

 private:
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Stands still until stepped. For tests: step(), then Machine::runPending(), on the same thread.
class SteppedClock : public Clock {
 public:
  std::chrono::nanoseconds now() const override { return frame_ * std::chrono::nanoseconds(kFramePeriod); }
  std::optional<std::chrono::steady_clock::time_point> timeOf(std::chrono::nanoseconds /*unused*/) const override {
    return std::nullopt;
  }

  /// Goes on by this many frames at once, as the wall's clock does while the host holds the process up. To have the
  /// machine see every single frame, step one and run.
  void step(longword frames = 1) { frame_ += frames; }

 private:
  longword frame_ = 0;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CLOCK_H
