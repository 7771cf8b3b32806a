#include "system/receipt_clock.h"

#include <algorithm>

namespace aibo_system {

void ReceiptClock::alive(TimePoint now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  noteLife(now);
}

ReceiptClock::TimePoint ReceiptClock::receipt(TimePoint now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (last_) {
    noteLife(now);
  }
  return now < caught_up_ ? before_gap_ : now;
}

void ReceiptClock::noteLife(TimePoint now) {
  if (last_ && now - *last_ > kLongestGap) {
    before_gap_ = *last_;
    caught_up_ = now + kCatchingUp;
  }
  last_ = std::max(last_.value_or(now), now);
}

}  // namespace aibo_system
