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

/// Carries packets between two stations. They share the air, which carries one packet at a time; when both have packets
/// to send, they take turns, as 802.11 gives each station the same chance. No packet overtakes another of its station.
/// Uses no sockets and no clock.
class RadioMedium {
 public:
  /// Time since the beginning.
  using Time = std::chrono::nanoseconds;
  using Bytes = std::vector<std::uint8_t>;

  enum Direction { kUp = 0, kDown = 1 };

  struct Packet {
    Direction direction;
    Time arrival;
    Bytes bytes;
  };

  explicit RadioMedium(const RadioOptions& options);

  /// A station wants to send a packet.
  /// @param now not less than in the last call, as in the other functions
  /// @return false if its queue is full: the packet is dropped
  bool send(Direction direction, Bytes bytes, Time now);

  /// The next packet that has arrived; nothing if none has. Packets that are lost never arrive.
  std::optional<Packet> receive(Time now);

  /// When to call receive() again if nobody sends; nothing if no packet is under way.
  std::optional<Time> nextEvent(Time now);

 private:
  struct Waiting {
    Time since;
    Bytes bytes;
  };

  bool isOut(Time time) const;
  std::optional<Direction> nextSender(Time* begin) const;
  void carryUntil(Time now);
  void carry(Direction direction, Time begin);

  const RadioOptions options_;
  std::mt19937 random_;
  std::deque<Waiting> queues_[2];  // a packet on the air is in its queue until it has left the air
  Direction last_sender_ = kDown;
  bool air_is_busy_ = false;  // with the first packet of last_sender_
  Time air_is_free_{0};
  std::deque<Packet> under_way_[2];  // after the air, in the order of arrival
  Time last_arrival_[2] = {};
};

}  // namespace fault_bench

#endif  // TEST_FAULT_RADIO_RADIO_MEDIUM_H
