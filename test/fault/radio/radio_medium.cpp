#include "radio/radio_medium.h"

#include <algorithm>
#include <utility>

namespace fault_bench {

RadioMedium::RadioMedium(const RadioOptions& options) : options_(options), random_(options.seed) {}

bool RadioMedium::send(Direction direction, Bytes bytes, Time now) {
  carryUntil(now);
  if (queues_[direction].size() >= options_.queue_length) {
    return false;
  }
  queues_[direction].push_back({now, std::move(bytes)});
  carryUntil(now);
  return true;
}

std::optional<RadioMedium::Packet> RadioMedium::receive(Time now) {
  carryUntil(now);
  for (std::deque<Packet>& packets : under_way_) {
    if (!packets.empty() && packets.front().arrival <= now) {
      Packet packet = std::move(packets.front());
      packets.pop_front();
      return packet;
    }
  }
  return std::nullopt;
}

std::optional<RadioMedium::Time> RadioMedium::nextEvent(Time now) {
  carryUntil(now);
  std::optional<Time> next;
  if (air_is_busy_) {
    next = air_is_free_;
  }
  for (const std::deque<Packet>& packets : under_way_) {
    if (!packets.empty() && (!next || packets.front().arrival < *next)) {
      next = packets.front().arrival;
    }
  }
  return next;
}

void RadioMedium::carryUntil(Time now) {
  Time begin{0};
  while (true) {
    if (air_is_busy_) {
      if (air_is_free_ > now) {
        return;
      }
      air_is_busy_ = false;
      queues_[last_sender_].pop_front();
    }
    const std::optional<Direction> sender = nextSender(&begin);
    if (!sender) {
      return;
    }
    carry(*sender, begin);
  }
}

/// @param[out] begin when its packet goes on the air
std::optional<RadioMedium::Direction> RadioMedium::nextSender(Time* begin) const {
  std::optional<Direction> sender;
  const Direction other = last_sender_ == kUp ? kDown : kUp;
  for (const Direction direction : {other, last_sender_}) {
    if (queues_[direction].empty()) {
      continue;
    }
    const Time ready = std::max(air_is_free_, queues_[direction].front().since);
    if (!sender || ready < *begin) {
      sender = direction;
      *begin = ready;
    }
  }
  return sender;
}

void RadioMedium::carry(Direction direction, Time begin) {
  Bytes& bytes = queues_[direction].front().bytes;
  const std::chrono::duration<double> airtime(8.0 * static_cast<double>(bytes.size()) / options_.bits_per_second);
  air_is_free_ = begin + options_.overhead + std::chrono::duration_cast<std::chrono::nanoseconds>(airtime);
  air_is_busy_ = true;
  last_sender_ = direction;
  // Random numbers are drawn for every packet, so that an outage does not change the fate of later packets.
  const bool is_lost = std::uniform_real_distribution<double>(0, 1)(random_) < options_.loss;
  const std::chrono::microseconds jitter(
      std::uniform_int_distribution<std::int64_t>(0, options_.jitter.count())(random_));
  if (is_lost || isOut(air_is_free_)) {
    return;
  }
  last_arrival_[direction] = std::max(last_arrival_[direction], air_is_free_ + options_.delay + jitter);
  under_way_[direction].push_back({direction, last_arrival_[direction], std::move(bytes)});
}

bool RadioMedium::isOut(Time time) const {
  return std::any_of(options_.outages.begin(), options_.outages.end(), [time](const Outage& outage) {
    return outage.begin <= time && time < outage.begin + outage.length;
  });
}

}  // namespace fault_bench
