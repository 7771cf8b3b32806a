#include "radio/radio_medium.h"

#include <algorithm>

namespace fault_bench {

RadioMedium::RadioMedium(const RadioOptions& options) : options_(options), random_(options.seed) {}

std::optional<RadioMedium::Time> RadioMedium::send(Direction direction, std::size_t bytes, Time now) {
  while (!waiting_.empty() && waiting_.front() <= now) {
    waiting_.pop_front();
  }
  if (waiting_.size() >= options_.queue_length) {
    return std::nullopt;
  }
  const std::chrono::duration<double> airtime(8.0 * static_cast<double>(bytes) / options_.bits_per_second);
  air_is_free_ =
      std::max(air_is_free_, now) + options_.overhead + std::chrono::duration_cast<std::chrono::nanoseconds>(airtime);
  waiting_.push_back(air_is_free_);
  // Random numbers are drawn for every packet, so that an outage does not change the fate of later packets.
  const bool is_lost = std::uniform_real_distribution<double>(0, 1)(random_) < options_.loss;
  const std::chrono::microseconds jitter(
      std::uniform_int_distribution<std::int64_t>(0, options_.jitter.count())(random_));
  if (is_lost || isOut(air_is_free_)) {
    return std::nullopt;
  }
  last_arrival_[direction] = std::max(last_arrival_[direction], air_is_free_ + options_.delay + jitter);
  return last_arrival_[direction];
}

bool RadioMedium::isOut(Time time) const {
  return std::any_of(options_.outages.begin(), options_.outages.end(), [time](const Outage& outage) {
    return outage.begin <= time && time < outage.begin + outage.length;
  });
}

}  // namespace fault_bench
