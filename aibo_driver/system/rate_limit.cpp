#include "system/rate_limit.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace aibo_system {

RateLimit::Admission RateLimit::admit(TimePoint now, Duration period, int count) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::int64_t periods = period > Duration::zero() ? (now - refilled_) / period : 0;
  allowed_ = static_cast<int>(std::min<std::int64_t>(burst_, allowed_ + periods));
  refilled_ = allowed_ == burst_ || period == Duration::zero() ? now : refilled_ + periods * period;
  if (allowed_ < count) {
    return {false, ++left_out_};
  }
  allowed_ -= count;
  return {true, std::exchange(left_out_, 0)};
}

}  // namespace aibo_system
