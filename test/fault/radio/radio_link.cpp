#include "radio/radio_link.h"

#include <poll.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <utility>

namespace fault_bench {
namespace {

using std::chrono::nanoseconds;
using std::chrono::steady_clock;

constexpr std::size_t kLargestPacket = 65535;

timespec toTimespec(nanoseconds time) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(time);
  return {static_cast<time_t>(seconds.count()), static_cast<long>((time - seconds).count())};
}

}  // namespace

RadioLink::RadioLink(const NetworkHost& one, const NetworkHost& other, const RadioOptions& options)
    : hosts_{one.packets(), other.packets()}, medium_(options) {
  thread_ = std::thread([this] { run(); });
}

RadioLink::~RadioLink() {
  stopping_ = true;
  stop_event_.raise();
  thread_.join();
}

void RadioLink::run() {
  while (!stopping_) {
    waitForWork();
    takePackets(RadioMedium::kUp);
    takePackets(RadioMedium::kDown);
    deliverPackets();
  }
}

void RadioLink::waitForWork() const {
  nanoseconds patience = std::chrono::hours(1);
  for (const std::vector<Packet>& packets : under_way_) {
    if (!packets.empty()) {
      patience = std::min<nanoseconds>(patience, packets.front().arrival - steady_clock::now());
    }
  }
  const timespec timeout = toTimespec(std::max(patience, nanoseconds(0)));
  pollfd polled[] = {{stop_event_.descriptor(), POLLIN, 0}, {hosts_[0], POLLIN, 0}, {hosts_[1], POLLIN, 0}};
  ::ppoll(polled, 3, &timeout, nullptr);
}

void RadioLink::takePackets(RadioMedium::Direction direction) {
  std::vector<std::uint8_t> bytes(kLargestPacket);
  for (ssize_t size; (size = ::read(hosts_[direction], bytes.data(), bytes.size())) > 0;) {
    const auto arrival = medium_.send(direction, static_cast<std::size_t>(size), steady_clock::now() - begin_);
    if (!arrival) {
      ++lost_;
      continue;
    }
    under_way_[direction].push_back({begin_ + *arrival, hosts_[1 - direction], {bytes.begin(), bytes.begin() + size}});
  }
}

void RadioLink::deliverPackets() {
  const auto now = steady_clock::now();
  for (std::vector<Packet>& packets : under_way_) {
    const auto is_under_way = [now](const Packet& packet) { return packet.arrival > now; };
    const auto end = std::find_if(packets.begin(), packets.end(), is_under_way);
    for (auto packet = packets.begin(); packet != end; ++packet) {
      // A packet that the host does not take is lost, as with any network card.
      ++(::write(packet->receiver, packet->bytes.data(), packet->bytes.size()) > 0 ? carried_ : lost_);
    }
    packets.erase(packets.begin(), end);
  }
}

}  // namespace fault_bench
