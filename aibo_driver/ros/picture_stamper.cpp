#include "picture_stamper.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace aibo_driver {
namespace {

// ros::Time throws when it would get negative or when its seconds would not fit 32 bits.
ros::Time fromNanoseconds(std::int64_t nanoseconds) {
  constexpr std::int64_t kLast = std::int64_t{std::numeric_limits<std::uint32_t>::max()} * 1000000000;
  ros::Time time;
  time.fromNSec(static_cast<std::uint64_t>(std::clamp<std::int64_t>(nanoseconds, 0, kLast)));
  return time;
}

}  // namespace

PictureStamper::PictureStamper(std::chrono::nanoseconds time_offset, std::function<ros::Time()> ros_now,
                               std::function<SteadyTime()> steady_now)
    : time_offset_(time_offset), ros_now_(std::move(ros_now)), steady_now_(std::move(steady_now)) {}

ros::Time PictureStamper::stamp(SteadyTime first_byte_time) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::size_t remembered = std::min(count_, kRemembered);
  for (std::size_t i = 0; i < remembered; ++i) {
    if (latest_[i].first_byte_time == first_byte_time) {
      return latest_[i].stamp;
    }
  }
  const std::chrono::nanoseconds age = steady_now_() - first_byte_time;
  const std::int64_t nanoseconds = static_cast<std::int64_t>(ros_now_().toNSec()) - age.count() + time_offset_.count();
  ros::Time stamp = fromNanoseconds(nanoseconds);
  if (count_ > 0) {
    const ros::Time last = latest_[(count_ - 1) % kRemembered].stamp;
    const bool clock_was_set_back = stamp + ros::Duration(kClockStep.count()) < last;
    if (stamp <= last && !clock_was_set_back) {
      stamp = last + ros::Duration(0, 1);
    }
  }
  latest_[count_ % kRemembered] = {first_byte_time, stamp};
  ++count_;
  return stamp;
}

}  // namespace aibo_driver
