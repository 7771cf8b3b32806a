#ifndef TEST_FAULT_RADIO_RADIO_MEDIUM_H
#define TEST_FAULT_RADIO_RADIO_MEDIUM_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <random>
#include <vector>

namespace fault_bench {

/// A period in which nothing gets through; it is counted from the beginning.
struct Outage {
  std::chrono::milliseconds begin{0};
  std::chrono::milliseconds length{0};
};

/// Properties of a radio link such as 802.11b.
struct RadioOptions {
  double bits_per_second = 11e6;            ///< above 0; 802.11b has 11, 5.5, 2 and 1 Mbit/s
  std::chrono::microseconds overhead{750};  ///< for each packet: preamble, waiting, acknowledgement; not below 0
  std::chrono::microseconds delay{1000};    ///< of each packet, after its time on the air; not below 0
  std::chrono::microseconds jitter{1000};   ///< largest random addition to the delay; not below 0
  double loss = 0;                          ///< share of lost packets, 0..1
  std::size_t queue_length = 50;            ///< most packets that wait for the air; others are dropped
  std::uint32_t seed = 1;                   ///< of loss and jitter
  std::vector<Outage> outages;
};

/// Computes when a packet arrives, if it does. Both directions share the air, which carries one packet at a time. No
/// packet overtakes another. Uses no sockets and no clock.
class RadioMedium {
 public:
  /// Time since the beginning.
  using Time = std::chrono::nanoseconds;

  enum Direction { kUp = 0, kDown = 1 };

  explicit RadioMedium(const RadioOptions& options);

  /// Sends a packet.
  /// @param now not less than in the last call
  /// @return when it arrives; nothing if it is lost or the queue is full
  std::optional<Time> send(Direction direction, std::size_t bytes, Time now);

 private:
  bool isOut(Time time) const;

  const RadioOptions options_;
  std::mt19937 random_;
  std::deque<Time> waiting_;  // for each packet that waits or is on the air: when it leaves the air
  Time air_is_free_{0};
  Time last_arrival_[2] = {};
};

}  // namespace fault_bench

#endif  // TEST_FAULT_RADIO_RADIO_MEDIUM_H
