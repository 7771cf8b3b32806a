/// @file clock.h
/// The machine's time, in OPEN-R frames of 8 ms; frame 0 is when the clock was made (report, section 2.1.1).
#ifndef OPENR_HOST_CLOCK_H
#define OPENR_HOST_CLOCK_H

#include <OPENR/OPENR.h>

#include <chrono>
#include <optional>

namespace openr_host {

constexpr std::chrono::milliseconds kFramePeriod{8};

class Clock {
 public:
  virtual ~Clock() = default;

  /// The frame that it is now.
  virtual longword frame() const = 0;

  /// When a frame begins; empty if only the caller of SteppedClock::step() knows.
  virtual std::optional<std::chrono::steady_clock::time_point> beginOf(longword frame) const = 0;
};

/// Goes with the steady clock: every frame's begin is reckoned from frame 0, so that nothing drifts.
class WallClock : public Clock {
 public:
  WallClock();
  longword frame() const override;
  std::optional<std::chrono::steady_clock::time_point> beginOf(longword frame) const override;

 private:
  const std::chrono::steady_clock::time_point begin_;
};

/// Stands still until stepped. For tests: step(), then Machine::runPending(), on the same thread.
class SteppedClock : public Clock {
 public:
  longword frame() const override { return frame_; }
  std::optional<std::chrono::steady_clock::time_point> beginOf(longword frame) const override;

  /// Goes on by this many frames at once, as the wall's clock does while the host holds the process up. To have the
  /// machine see every single frame, step one and run.
  void step(longword frames = 1) { frame_ += frames; }

 private:
  longword frame_ = 0;
};

}  // namespace openr_host

#endif  // OPENR_HOST_CLOCK_H
