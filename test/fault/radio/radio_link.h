#ifndef TEST_FAULT_RADIO_RADIO_LINK_H
#define TEST_FAULT_RADIO_RADIO_LINK_H

#include <array>
#include <atomic>
#include <chrono>
#include <thread>

#include "radio/network_host.h"
#include "radio/radio_medium.h"
#include "system/event.h"

namespace fault_bench {

/// Carries the packets between two hosts as a radio would, on a thread of its own.
class RadioLink {
 public:
  /// The hosts must outlive the link.
  RadioLink(const NetworkHost& one, const NetworkHost& other, const RadioOptions& options);
  ~RadioLink();

  RadioLink(const RadioLink&) = delete;
  RadioLink& operator=(const RadioLink&) = delete;

  /// The times of RadioOptions::outages count from here.
  std::chrono::steady_clock::time_point begin() const { return begin_; }

 private:
  void run();
  void takePackets(RadioMedium::Direction direction);
  void deliverPackets();
  void waitForWork();
  RadioMedium::Time now() const { return std::chrono::steady_clock::now() - begin_; }

  const std::array<int, 2> hosts_;  // descriptors of their packets
  RadioMedium medium_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  aibo_system::Event stop_event_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace fault_bench

#endif  // TEST_FAULT_RADIO_RADIO_LINK_H
