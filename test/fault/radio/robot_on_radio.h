#ifndef TEST_FAULT_RADIO_ROBOT_ON_RADIO_H
#define TEST_FAULT_RADIO_ROBOT_ON_RADIO_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "radio/network_host.h"
#include "simulator/ers7/simulated_ers7.h"
#include "simulator/sent_pictures.h"
#include "support/robot_thread.h"

namespace fault_bench {

/// The real RCServer with a simulated ERS-7, on a host of its own. It remembers all pictures that it sends.
class RobotOnRadio {
 public:
  struct Sent {
    std::uint64_t number;                            ///< in the order of sending; the first is 1
    std::chrono::steady_clock::time_point image_at;  ///< when the camera had the image
  };

  /// @throw openr_host::BootError
  explicit RobotOnRadio(const NetworkHost& host);

  /// Looks up a picture; nothing if it was never sent. Any thread.
  std::optional<Sent> find(const std::vector<std::uint8_t>& jpeg) const;

 private:
  openr_host::MachineOptions machineOptions(const NetworkHost& host);
  void cameraImageTaken();
  void aboutToSend(const void* data, std::size_t size);

  mutable std::mutex mutex_;                          // guards what follows, down to the robot
  std::map<std::size_t, Sent> sent_;                  // by the hash of their bytes
  std::chrono::steady_clock::time_point image_at_;    // the camera's last one
  std::chrono::steady_clock::time_point picture_at_;  // that of the picture that is being sent
  SentPictures pictures_;

  simulated_ers7::SimulatedErs7 robot_;
  test_support::RobotThread thread_;
};

}  // namespace fault_bench

#endif  // TEST_FAULT_RADIO_ROBOT_ON_RADIO_H
