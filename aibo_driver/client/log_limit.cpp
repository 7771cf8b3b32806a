#include "client/log_limit.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace aibo_driver {

LogLimit::Admission LogLimit::admit(TimePoint now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto periods = (now - refilled_) / kPeriod;
  allowed_ = static_cast<int>(std::min<std::int64_t>(kBurst, allowed_ + periods));
  refilled_ = allowed_ == kBurst ? now : refilled_ + periods * kPeriod;
  if (allowed_ == 0) {
    return {false, ++left_out_};
  }
  --allowed_;
  return {true, std::exchange(left_out_, 0)};
}

}  // namespace aibo_driver
