#ifndef TEST_FAULT_RADIO_RADIO_LINK_H
#define TEST_FAULT_RADIO_RADIO_LINK_H

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <random>
#include <thread>
#include <vector>

#include "radio/network_host.h"
#include "system/event.h"

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

/// Carries the packets between two hosts as a radio would, on a thread of its own. They share the air, which carries
/// one packet at a time; when both have packets to send, they take turns, as 802.11 gives each station the same chance.
/// No packet overtakes another of its station.
class RadioLink {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// The hosts must outlive the link.
  RadioLink(const NetworkHost& one, const NetworkHost& other, const RadioOptions& options);
  ~RadioLink();

  RadioLink(const RadioLink&) = delete;
  RadioLink& operator=(const RadioLink&) = delete;

  /// The times of RadioOptions::outages count from here.
  TimePoint begin() const { return begin_; }

 private:
  struct Packet {
    TimePoint time;  // since when it waits, or when it arrives
    std::vector<std::uint8_t> bytes;
  };

  struct Station {
    int descriptor;                // of its packets
    std::deque<Packet> waiting{};  // for the air
    std::deque<Packet> sent{};     // until they arrive at the other one
    TimePoint last_arrival{};
  };

  void run();
  void takePackets(Station* station);
  void carryPackets(TimePoint now);
  void carry(Station* sender);
  void deliverPackets(TimePoint now);
  TimePoint nextEvent() const;
  bool isOut(TimePoint time) const;

  const RadioOptions options_;
  std::mt19937 random_{options_.seed};
  std::array<Station, 2> stations_;
  std::size_t last_sender_ = 0;
  const TimePoint begin_ = std::chrono::steady_clock::now();
  TimePoint air_is_free_ = begin_;
  aibo_system::Event stop_event_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace fault_bench

#endif  // TEST_FAULT_RADIO_RADIO_LINK_H
