#include "node/camera/link_quality.h"

#include <limits>

namespace aibo_driver::node {

LinkQuality toMessage(const camera::LinkMeter::Reading& reading, double asked_rate) {
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

}  // namespace aibo_driver::node
