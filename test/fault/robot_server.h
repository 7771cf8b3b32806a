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

#include "picture_encoder/PictureJob.h"
#include "simulator/ers7/simulated_ers7.h"
#include "support/robot_thread.h"

namespace fault_bench {

/// The robot's own server with a simulated ERS-7. It remembers all pictures that it encodes. Every function may be
/// called from any thread.
class RobotServer {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  struct Encoded {
    std::uint64_t number;  ///< in the order of encoding; the first is 1
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

  /// Looks up a picture; nothing if there was none like it.
  std::optional<Encoded> find(const std::vector<std::uint8_t>& jpeg) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = encoded_.find(hash(jpeg.data(), jpeg.size()));
    return found == encoded_.end() ? std::nullopt : std::optional<Encoded>(found->second);
  }

 private:
  static std::size_t hash(const unsigned char* bytes, std::size_t size) {
    return std::hash<std::string_view>()({reinterpret_cast<const char*>(bytes), size});
  }

  openr_host::MachineOptions heardBy(openr_host::MachineOptions options) {
    options.on_camera_image = [this] { noteImage(); };
    for (auto& observer : options.catalog.at("RCSERVER.BIN").observers) {
      if (observer.service == "RCServer.Picture.EncodedPicture.O") {
        observer.notify = [this, notify = observer.notify](OObject& object, const ONotifyEvent& event) {
          noteEncoded(*static_cast<const EncodedPicture*>(event.Data(0)));
          notify(object, event);
        };
      }
    }
    return options;
  }

  void noteImage() {
    const std::lock_guard<std::mutex> lock(mutex_);
    image_at_ = std::chrono::steady_clock::now();
  }

  void noteEncoded(const EncodedPicture& picture) {
    const std::lock_guard<std::mutex> lock(mutex_);
    encoded_[hash(picture.jpeg, picture.size)] = {encoded_.size() + 1, image_at_};
  }

  mutable std::mutex mutex_;                // guards what follows, down to the robot
  TimePoint image_at_;                      // the camera's last one
  std::map<std::size_t, Encoded> encoded_;  // by the hash of their bytes
  simulated_ers7::SimulatedErs7 robot_;
  test_support::RobotThread thread_;
};

}  // namespace fault_bench

#endif  // TEST_FAULT_ROBOT_SERVER_H
