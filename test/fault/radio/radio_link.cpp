#include "radio/radio_link.h"

#include <poll.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <vector>

namespace fault_bench {
namespace {

using std::chrono::nanoseconds;

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

void RadioLink::waitForWork() {
  const RadioMedium::Time present = now();
  const auto next = medium_.nextEvent(present);
  const nanoseconds patience = next ? std::max(*next - present, nanoseconds(0)) : std::chrono::hours(1);
  const timespec timeout = toTimespec(patience);
  pollfd polled[] = {{stop_event_.descriptor(), POLLIN, 0}, {hosts_[0], POLLIN, 0}, {hosts_[1], POLLIN, 0}};
  ::ppoll(polled, 3, &timeout, nullptr);
}

void RadioLink::takePackets(RadioMedium::Direction direction) {
  std::vector<std::uint8_t> bytes(kLargestPacket);
  for (ssize_t size; (size = ::read(hosts_[direction], bytes.data(), bytes.size())) > 0;) {
    medium_.send(direction, {bytes.begin(), bytes.begin() + size}, now());
  }
}

void RadioLink::deliverPackets() {
  while (const auto packet = medium_.receive(now())) {
    // A packet that the host does not take is lost, as with any network card.
    [[maybe_unused]] const ssize_t taken =
        ::write(hosts_[1 - packet->direction], packet->bytes.data(), packet->bytes.size());
  }
}

}  // namespace fault_bench
