#include "camera/link_meter.h"

#include <algorithm>
#include <utility>

namespace aibo_driver::camera {
namespace {

double secondsBetween(LinkMeter::SteadyTime begin, LinkMeter::SteadyTime end) {
  return std::chrono::duration<double>(end - begin).count();
}

}  // namespace

void LinkMeter::add(const aibo_client::Picture& picture, double age, int every_nth_image, SteadyTime now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++current_.pictures;
  current_.bytes += picture.jpeg.size();
  current_.longest_gap = std::max(current_.longest_gap, secondsBetween(last_, now));
  last_ = now;
  const double latency = secondsBetween(picture.first_byte_time, now);
  latency_sum_ += latency;
  current_.max_latency = std::max(current_.max_latency, latency);
  if (picture.frame_number) {
    ++aged_;
    age_sum_ += age;
    current_.worst_age = std::max(current_.worst_age.value_or(age), age);
  }
  if (const std::uint64_t due = imagesDue(picture, every_nth_image); due > 0) {
    ++counted_;
    due_ += due;
  }
}

// How many images were due is unknown for the first picture of a connection, and if the camera's count goes back.
std::uint64_t LinkMeter::imagesDue(const aibo_client::Picture& picture, int every_nth_image) {
  const std::optional<std::uint32_t> before =
      picture.connection_number == connection_number_ ? last_image_ : std::nullopt;
  connection_number_ = picture.connection_number;
  last_image_ = every_nth_image > 0 ? picture.image_count : std::nullopt;
  if (!before || every_nth_image == 0 || !picture.image_count || *picture.image_count <= *before) {
    return 0;
  }
  return std::max<std::uint64_t>((*picture.image_count - *before) / static_cast<std::uint32_t>(every_nth_image), 1);
}

LinkMeter::Reading LinkMeter::read(SteadyTime now, double asked_rate) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Reading reading = std::exchange(current_, Reading());
  reading.seconds = secondsBetween(std::exchange(begin_, now), now);
  reading.longest_gap = std::max(reading.longest_gap, secondsBetween(last_, now));
  if (reading.pictures > 0) {
    reading.mean_latency = std::exchange(latency_sum_, 0) / static_cast<double>(reading.pictures);
  }
  const double asked_before = std::exchange(last_asked_rate_, asked_rate);
  if (asked_before > 0 && asked_rate == 0) {
    last_image_.reset();  // no image was due during the pause
  }
  const double due = std::min(asked_rate, asked_before);
  slow_for_ = reading.picturesPerSecond() < due / 2 ? slow_for_ + reading.seconds : 0;
  reading.slow_for = slow_for_;
  if (aged_ > 0) {
    reading.mean_age = std::exchange(age_sum_, 0) / static_cast<double>(std::exchange(aged_, 0));
  }
  if (due_ > 0) {
    reading.loss = 1 - static_cast<double>(std::exchange(counted_, 0)) / static_cast<double>(std::exchange(due_, 0));
  }
  return reading;
}

}  // namespace aibo_driver::camera
