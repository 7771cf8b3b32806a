/// @file robot_server.h
#ifndef TEST_FAULT_CAMPAIGN_ROBOT_SERVER_H
#define TEST_FAULT_CAMPAIGN_ROBOT_SERVER_H

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <set>
#include <string_view>
#include <vector>

#include "campaign/interposers.h"
#include "simulator/ers7/simulated_ers7.h"
#include "simulator/sent_pictures.h"
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

  /// True if a picture with these bytes was sent.
  bool hasSent(const std::vector<std::uint8_t>& jpeg) const {
    const std::lock_guard<std::mutex> lock(sent_mutex_);
    return sent_.count(std::hash<std::string_view>()({reinterpret_cast<const char*>(jpeg.data()), jpeg.size()})) > 0;
  }

  /// The longest time from one camera image to the next, since this was called last.
  std::chrono::milliseconds takeLongestImageGap() { return std::chrono::milliseconds(longest_gap_.exchange(0)); }

 private:
  openr_host::MachineOptions options() {
    openr_host::MachineOptions options = test_support::RobotThread::defaultOptions();
    options.on_camera_image = [this] { noteImage(); };
    options.on_send = [this](const void* data, std::size_t size) { noteSend(data, size); };
    return options;
  }

  void noteSend(const void* data, std::size_t size) {
    pictures_.add(data, size);
    if (pictures_.isComplete()) {
      const std::lock_guard<std::mutex> lock(sent_mutex_);
      sent_.insert(std::hash<std::string_view>()(pictures_.jpeg()));
    }
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
  SentPictures pictures_;  // used by the server's thread alone
  mutable std::mutex sent_mutex_;
  std::set<std::size_t> sent_;  // hashes of pictures; guarded by sent_mutex_
  simulated_ers7::SimulatedErs7 robot_;
  test_support::RobotThread thread_;
};

}  // namespace fault_bench

#endif  // TEST_FAULT_CAMPAIGN_ROBOT_SERVER_H
