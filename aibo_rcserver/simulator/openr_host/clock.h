/// @file clock.h
/// The machine's time, in OPEN-R frames of 8 ms. Frame 0 begins when the clock is created (report, section 2.1.1).
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CLOCK_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CLOCK_H

#include <OPENR/OPENR.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>

namespace openr_host {

constexpr std::chrono::milliseconds kFramePeriod{8};
constexpr double kFrameSeconds = 0.008;

/// Called after an object has handled data from another one. Returns how long this keeps the object busy, 0 or more.
/// @param object the object's name
using HandlerTime = std::function<std::chrono::nanoseconds(const std::string& object)>;

class Clock {
 public:
  virtual ~Clock() = default;

  /// The time since the clock was created.
  virtual std::chrono::nanoseconds now() const = 0;

  /// When the steady clock reaches `since_begin`; empty for a SteppedClock, which cannot know.
  virtual std::optional<std::chrono::steady_clock::time_point> timeOf(std::chrono::nanoseconds since_begin) const = 0;

  longword frame() const { return static_cast<longword>(now() / kFramePeriod); }

  /// When a frame begins; empty if timeOf() is.
  std::optional<std::chrono::steady_clock::time_point> beginOf(longword frame) const {
    return timeOf(frame * std::chrono::nanoseconds(kFramePeriod));
  }
};

/// Follows the steady clock. Every frame begins a multiple of 8 ms after frame 0, so nothing drifts.
class WallClock : public Clock {
 public:
  std::chrono::nanoseconds now() const override { return std::chrono::steady_clock::now() - begin_; }
  std::optional<std::chrono::steady_clock::time_point> timeOf(std::chrono::nanoseconds since_begin) const override {
    return begin_ + since_begin;
  }

 private:
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Stands still until it is stepped. Tests call step(), then Machine::runPending(), on the same thread.
class SteppedClock : public Clock {
 public:
  std::chrono::nanoseconds now() const override { return frame_ * std::chrono::nanoseconds(kFramePeriod); }
  std::optional<std::chrono::steady_clock::time_point> timeOf(std::chrono::nanoseconds /*unused*/) const override {
    return std::nullopt;
  }

  /// Advances by this many frames at once, as a WallClock does after the process was delayed. If the machine is to see
  /// every frame, run it after each.
  void step(longword frames = 1) { frame_ += frames; }

 private:
  longword frame_ = 0;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CLOCK_H
