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

/// A time in which nothing gets through, counted from the beginning.
struct Outage {
  std::chrono::milliseconds begin{0};
  std::chrono::milliseconds length{0};
};

/// A radio link, as 802.11b is one.
struct RadioOptions {
  double bits_per_second = 11e6;            ///< above 0; 802.11b has 11, 5.5, 2 and 1 Mbit/s
  std::chrono::microseconds overhead{750};  ///< of each packet: preamble, waiting, acknowledgement; not below 0
  std::chrono::microseconds delay{1000};    ///< that each packet has beyond its time on the air; not below 0
  std::chrono::microseconds jitter{1000};   ///< up to so much more, at random; not below 0
  double loss = 0;                          ///< share of the packets that get lost, 0..1
  std::size_t queue_length = 50;            ///< packets that wait for the air; what comes beyond is dropped
  std::uint32_t seed = 1;                   ///< of loss and jitter
  std::vector<Outage> outages;
};

/// When a packet arrives, if it does. Both directions share the air: only one packet is on it at a time. Nothing
/// overtakes. No sockets and no clock in it.
class RadioMedium {
 public:
  /// Time since the beginning.
  using Time = std::chrono::nanoseconds;

  enum Direction { kUp = 0, kDown = 1 };

  explicit RadioMedium(const RadioOptions& options);

  /// A packet is to be sent.
  /// @param now never less than in the call before
  /// @return when it arrives; nothing if it gets lost or the queue is full
  std::optional<Time> send(Direction direction, std::size_t bytes, Time now);

 private:
  bool isOut(Time time) const;

  const RadioOptions options_;
  std::mt19937 random_;
  std::deque<Time> waiting_;  // when each packet that waits, or is on the air, leaves the air
  Time air_is_free_{0};
  Time last_arrival_[2] = {};
};

}  // namespace fault_bench

#endif  // TEST_FAULT_RADIO_RADIO_MEDIUM_H
