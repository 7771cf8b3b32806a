/// @file robot_server.h
#ifndef TEST_FAULT_ROBOT_SERVER_H
#define TEST_FAULT_ROBOT_SERVER_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "simulator/ers7/simulated_ers7.h"
#include "simulator/sent_pictures.h"
#include "support/robot_thread.h"

namespace fault_bench {

/// The robot's own server with a simulated ERS-7. It remembers all pictures that it sends. Every function may be called
/// from any thread.
class RobotServer {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  struct Sent {
    std::uint64_t number;  ///< in the order of sending; the first is 1
    TimePoint image_at;    ///< when the camera had the image
  };

  /// @param begin what its thread does first, if anything
  /// @param options their callbacks are the server's own
  /// @throw openr_host::BootError
  explicit RobotServer(const std::function<void()>& begin = nullptr,
                       openr_host::MachineOptions options = test_support::RobotThread::defaultOptions())
      : thread_(robot_, heardBy(std::move(options)), begin) {}

  /// Of the address that the options bind it to.
  int port() const { return thread_.port(); }

  /// Looks up a picture; nothing if it was never sent.
  std::optional<Sent> find(const std::vector<std::uint8_t>& jpeg) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = sent_.find(hash({reinterpret_cast<const char*>(jpeg.data()), jpeg.size()}));
    return found == sent_.end() ? std::nullopt : std::optional<Sent>(found->second);
  }

 private:
  static std::size_t hash(std::string_view bytes) { return std::hash<std::string_view>()(bytes); }

  openr_host::MachineOptions heardBy(openr_host::MachineOptions options) {
    options.on_camera_image = [this] { noteImage(); };
    options.on_send = [this](const void* data, std::size_t size) { noteSend(data, size); };
    return options;
  }

  void noteImage() {
    const std::lock_guard<std::mutex> lock(mutex_);
    image_at_ = std::chrono::steady_clock::now();
  }

  void noteSend(const void* data, std::size_t size) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (pictures_.add(data, size)) {
      picture_at_ = image_at_;
    }
    if (pictures_.isComplete()) {
      sent_[hash(pictures_.jpeg())] = {sent_.size() + 1, picture_at_};
    }
  }

  mutable std::mutex mutex_;  // guards what follows, down to the robot
  TimePoint image_at_;        // the camera's last one
  TimePoint picture_at_;      // that of the picture that is being sent
  SentPictures pictures_;
  std::map<std::size_t, Sent> sent_;  // by the hash of their bytes
  simulated_ers7::SimulatedErs7 robot_;
  test_support::RobotThread thread_;
};

}  // namespace fault_bench

#endif  // TEST_FAULT_ROBOT_SERVER_H
