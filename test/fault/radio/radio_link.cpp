#include "radio/radio_link.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace fault_bench {

constexpr std::size_t kLargestPacket = 65535;

RadioLink::RadioLink(const NetworkHost& one, const NetworkHost& other, const RadioOptions& options)
    : options_(options), stations_{{{one.packets()}, {other.packets()}}} {
  thread_ = std::thread([this] { run(); });
}

RadioLink::~RadioLink() {
  stopping_ = true;
  stop_event_.raise();
  thread_.join();
}

void RadioLink::run() {
  while (!stopping_) {
    pollfd polled[] = {{stop_event_.descriptor(), POLLIN, 0},
                       {stations_[0].descriptor, POLLIN, 0},
                       {stations_[1].descriptor, POLLIN, 0}};
    const std::chrono::nanoseconds left = nextEvent() - std::chrono::steady_clock::now();
    const timespec timeout = {0, std::clamp<long>(left.count(), 0, 999999999)};
    ::ppoll(polled, std::size(polled), &timeout, nullptr);
    takePackets(&stations_[0]);
    takePackets(&stations_[1]);
    carryPackets(std::chrono::steady_clock::now());
    deliverPackets(std::chrono::steady_clock::now());
  }
}

RadioLink::TimePoint RadioLink::nextEvent() const {
  TimePoint next = std::chrono::steady_clock::now() + std::chrono::hours(1);
  for (const Station& station : stations_) {
    next = station.waiting.empty() ? next : std::min(next, air_is_free_);
    next = station.sent.empty() ? next : std::min(next, station.sent.front().time);
  }
  return next;
}

void RadioLink::takePackets(Station* station) {
  std::vector<std::uint8_t> bytes(kLargestPacket);
  for (ssize_t size; (size = ::read(station->descriptor, bytes.data(), bytes.size())) > 0;) {
    const auto now = std::chrono::steady_clock::now();
    carryPackets(now);
    if (station->waiting.size() < options_.queue_length) {
      station->waiting.push_back({now, {bytes.begin(), bytes.begin() + size}});
    }
  }
}

void RadioLink::carryPackets(TimePoint now) {
  while (air_is_free_ <= now) {
    const std::size_t other = 1 - last_sender_;
    last_sender_ = stations_[other].waiting.empty() ? last_sender_ : other;
    if (stations_[last_sender_].waiting.empty()) {
      return;
    }
    carry(&stations_[last_sender_]);
  }
}

void RadioLink::carry(Station* sender) {
  Packet packet = std::move(sender->waiting.front());
  sender->waiting.pop_front();
  const std::chrono::duration<double> airtime(8.0 * static_cast<double>(packet.bytes.size()) /
                                              options_.bits_per_second);
  air_is_free_ = std::max(air_is_free_, packet.time) + options_.overhead +
                 std::chrono::duration_cast<std::chrono::nanoseconds>(airtime);
  // Random numbers are drawn for every packet, so that an outage does not change the fate of later packets.
  const bool is_lost = std::uniform_real_distribution<double>(0, 1)(random_) < options_.loss;
  const std::chrono::microseconds jitter(
      std::uniform_int_distribution<std::int64_t>(0, options_.jitter.count())(random_));
  if (!is_lost && !isOut(air_is_free_)) {
    sender->last_arrival = std::max(sender->last_arrival, air_is_free_ + options_.delay + jitter);
    sender->sent.push_back({sender->last_arrival, std::move(packet.bytes)});
  }
}

void RadioLink::deliverPackets(TimePoint now) {
  for (std::size_t from = 0; from < stations_.size(); ++from) {
    std::deque<Packet>& sent = stations_[from].sent;
    for (; !sent.empty() && sent.front().time <= now; sent.pop_front()) {
      const std::vector<std::uint8_t>& bytes = sent.front().bytes;
      // A packet that the host does not take is lost, as with any network card.
      [[maybe_unused]] const ssize_t taken = ::write(stations_[1 - from].descriptor, bytes.data(), bytes.size());
    }
  }
}

bool RadioLink::isOut(TimePoint time) const {
  return std::any_of(options_.outages.begin(), options_.outages.end(), [&](const Outage& outage) {
    return begin_ + outage.begin <= time && time < begin_ + outage.begin + outage.length;
  });
}

}  // namespace fault_bench
