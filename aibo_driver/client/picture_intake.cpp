#include "client/picture_intake.h"

namespace aibo_driver {

void StreamControl::toggled(int quality, TimePoint now) {
  on_ = !on_;
  quality_ = quality;
  if (!on_) {
    off_since_ = now;
    quiet_since_ = now;
  }
}

StreamControl::TimePoint StreamControl::drainedAt() const {
  return quiet_since_ == TimePoint::min() ? quiet_since_ : quiet_since_ + kDrainTime;
}

}  // namespace aibo_driver
