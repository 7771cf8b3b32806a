/// @file robot_server.h
#ifndef TEST_FAULT_CAMPAIGN_ROBOT_SERVER_H
#define TEST_FAULT_CAMPAIGN_ROBOT_SERVER_H

#include <atomic>
#include <chrono>
#include <cstdint>

#include "campaign/interposers.h"
#include "simulator/ers7/simulated_ers7.h"
#include "support/robot_thread.h"

namespace fault_bench {

/// The robot's own server with a simulated ERS-7. Every function may be called from any thread.
class RobotServer {
 public:
  /// @param mark of its thread (interposers.h)
  explicit RobotServer(int mark) : thread_(robot_, options(), [mark] { interposers::markThisThread(mark); }) {}

  /// On 127.0.0.1.
  int port() const { return thread_.port(); }

  /// The present OPEN-R frame (8 ms).
  std::uint32_t frame() const { return thread_.frame(); }

  /// The longest time from one camera image to the next, since this was called last.
  std::chrono::milliseconds takeLongestImageGap() { return std::chrono::milliseconds(longest_gap_.exchange(0)); }

 private:
  openr_host::MachineOptions options() {
    openr_host::MachineOptions options = test_support::RobotThread::defaultOptions();
    options.on_camera_image = [this] { noteImage(); };
    return options;
  }

  void noteImage() {
    const auto now = std::chrono::steady_clock::now();
    const auto gap = std::chrono::duration_cast<std::chrono::milliseconds>(now - last_image_).count();
    if (last_image_.time_since_epoch().count() > 0 && gap > longest_gap_) {
      longest_gap_ = gap;
    }
    last_image_ = now;
  }

  std::chrono::steady_clock::time_point last_image_;  // used by the server's thread alone
  std::atomic<std::chrono::milliseconds::rep> longest_gap_{0};
  simulated_ers7::SimulatedErs7 robot_;
  test_support::RobotThread thread_;
};

}  // namespace fault_bench

#endif  // TEST_FAULT_CAMPAIGN_ROBOT_SERVER_H
