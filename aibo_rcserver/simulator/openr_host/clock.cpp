#include "simulator/openr_host/clock.h"

namespace openr_host {

WallClock::WallClock() : begin_(std::chrono::steady_clock::now()) {}

std::chrono::nanoseconds WallClock::now() const {
  return std::chrono::steady_clock::now() - begin_;
}

std::optional<std::chrono::steady_clock::time_point> WallClock::timeOf(std::chrono::nanoseconds since_begin) const {
  return begin_ + since_begin;
}

std::optional<std::chrono::steady_clock::time_point> SteppedClock::timeOf(
    std::chrono::nanoseconds /*since_begin*/) const {
  return std::nullopt;
}

}  // namespace openr_host
