#include "node/camera/link_quality.h"

#include <chrono>
#include <limits>
#include <utility>

#include "node/camera/camera_options.h"

namespace aibo_driver::node {

using std::chrono::steady_clock;

LinkQuality toMessage(const LinkMeter::Reading& reading, double asked_rate) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  LinkQuality quality;
  quality.pictures_per_second = static_cast<float>(reading.picturesPerSecond());
  quality.pictures_per_second_asked = static_cast<float>(asked_rate);
  quality.kilobytes_per_second = static_cast<float>(reading.kilobytesPerSecond());
  quality.age = static_cast<float>(reading.mean_age.value_or(kUnknown));
  quality.longest_age = static_cast<float>(reading.worst_age.value_or(kUnknown));
  quality.lost = static_cast<float>(reading.loss.value_or(kUnknown));
  return quality;
}

LinkQualityPublisher::LinkQualityPublisher(const ros::NodeHandle& handle,
                                           std::function<std::optional<int>()> asked_every_nth_image)
    : asked_every_nth_image_(std::move(asked_every_nth_image)) {
  publisher_ = ros::NodeHandle(handle).advertise<LinkQuality>("link_quality", 1);
}

void LinkQualityPublisher::add(const aibo_client::Picture& picture, const ros::Time& stamp) {
  meter_.add(picture, (ros::Time::now() - stamp).toSec(), asked_every_nth_image_().value_or(1), steady_clock::now());
}

void LinkQualityPublisher::publish() {
  const LinkMeter::Reading reading = meter_.read(steady_clock::now());
  const std::optional<int> every_nth = asked_every_nth_image_();
  LinkQuality message = toMessage(reading, every_nth ? frameRateOf(*every_nth) : 0);
  if (publisher_.getNumSubscribers() > 0) {
    message.header.stamp = ros::Time::now();
    publisher_.publish(message);
  }
}

}  // namespace aibo_driver::node
