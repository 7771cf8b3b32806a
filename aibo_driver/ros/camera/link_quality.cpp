#include "ros/camera/link_quality.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "ros/camera/camera_options.h"

namespace aibo_driver::node {
void LinkQualityMeter::add(const Picture& picture, double age, int every_nth_image) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++pictures_;
  bytes_ += picture.jpeg.size();
  if (picture.frame_number) {
    ++aged_;
    age_sum_ += age;
    longest_age_ = std::max(longest_age_, age);
  }
  if (const std::uint64_t due = imagesDue(picture, every_nth_image); due > 0) {
    ++counted_;
    due_ += due;
  }
}

// The first picture of a connection says nothing about those before it. The same holds if the count goes back.
std::uint64_t LinkQualityMeter::imagesDue(const Picture& picture, int every_nth_image) {
  const std::optional<std::uint32_t> before =
      picture.connection_number == connection_number_ ? last_image_ : std::nullopt;
  connection_number_ = picture.connection_number;
  last_image_ = picture.image_count;
  if (!before || !picture.image_count || *picture.image_count <= *before) {
    return 0;
  }
  return std::max<std::uint64_t>((*picture.image_count - *before) / static_cast<std::uint32_t>(every_nth_image), 1);
}

LinkQuality LinkQualityMeter::read(double seconds, double asked_rate) {
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto pictures = static_cast<double>(std::exchange(pictures_, 0));
  const auto aged = static_cast<double>(std::exchange(aged_, 0));
  const auto counted = static_cast<double>(std::exchange(counted_, 0));
  const auto due = static_cast<double>(std::exchange(due_, 0));
  const double age_sum = std::exchange(age_sum_, 0);
  const double longest_age = std::exchange(longest_age_, 0);
  LinkQuality quality;
  quality.pictures_per_second = static_cast<float>(pictures / seconds);
  quality.pictures_per_second_asked = static_cast<float>(asked_rate);
  quality.kilobytes_per_second = static_cast<float>(static_cast<double>(std::exchange(bytes_, 0)) / seconds / 1000);
  quality.age = aged > 0 ? static_cast<float>(age_sum / aged) : kUnknown;
  quality.longest_age = aged > 0 ? static_cast<float>(longest_age) : kUnknown;
  quality.lost = due > 0 ? static_cast<float>(1 - counted / due) : kUnknown;
  return quality;
}

LinkQualityPublisher::LinkQualityPublisher(const ros::NodeHandle& handle,
                                           std::function<std::optional<int>()> asked_every_nth_image)
    : asked_every_nth_image_(std::move(asked_every_nth_image)) {
  publisher_ = ros::NodeHandle(handle).advertise<LinkQuality>("link_quality", 1);
}

void LinkQualityPublisher::add(const Picture& picture, const ros::Time& stamp) {
  meter_.add(picture, (ros::Time::now() - stamp).toSec(), asked_every_nth_image_().value_or(1));
}

void LinkQualityPublisher::publish() {
  const ros::SteadyTime now = ros::SteadyTime::now();
  const double seconds = (now - std::exchange(last_publication_, now)).toSec();
  const std::optional<int> every_nth = asked_every_nth_image_();
  LinkQuality message = meter_.read(std::max(seconds, 1e-3), every_nth ? frameRateOf(*every_nth) : 0);
  if (publisher_.getNumSubscribers() > 0) {
    message.header.stamp = ros::Time::now();
    publisher_.publish(message);
  }
}

}  // namespace aibo_driver::node
