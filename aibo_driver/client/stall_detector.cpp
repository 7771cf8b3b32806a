#include "client/stall_detector.h"

namespace aibo_client {

void StallDetector::bytesArrived(TimePoint now) {
  last_bytes_ = now;
  if (!catching_up_ && now - last_empty_ > kStallLimit) {
    catching_up_ = true;
    catching_up_since_ = now;
  } else if (catching_up_ && now - catching_up_since_ > kCatchUpLimit) {
    restart(now);
  }
}

void StallDetector::foundEmpty(TimePoint now) {
  last_empty_ = now;
  if (catching_up_ && now - last_bytes_ >= kQuietTime) {
    catching_up_ = false;
    fresh_since_ = now;
  }
}

StallDetector::TimePoint StallDetector::nextLook() const {
  return catching_up_ ? last_bytes_ + kQuietTime : last_empty_ + kStallLimit / 2;
}

}  // namespace aibo_client
