#include "openr_host/clock.h"

namespace openr_host {

WallClock::WallClock() : begin_(std::chrono::steady_clock::now()) {}

longword WallClock::frame() const {
  return static_cast<longword>((std::chrono::steady_clock::now() - begin_) / kFramePeriod);
}

std::optional<std::chrono::steady_clock::time_point> WallClock::beginOf(longword frame) const {
  return begin_ + frame * std::chrono::duration_cast<std::chrono::nanoseconds>(kFramePeriod);
}

std::optional<std::chrono::steady_clock::time_point> SteppedClock::beginOf(longword /*frame*/) const {
  return std::nullopt;
}

}  // namespace openr_host
