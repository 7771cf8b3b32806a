/// @file robot_server.h
#ifndef TEST_FAULT_ROBOT_SERVER_H
#define TEST_FAULT_ROBOT_SERVER_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "picture_encoder/PictureJob.h"
#include "protocol/version1.h"
#include "simulator/ers7/simulated_ers7.h"
#include "simulator/object_catalog.h"
#include "simulator/openr_host/clock.h"
#include "simulator/openr_host/machine.h"

namespace fault_bench {

/// The robot's own server with a simulated ERS-7 and the project's memory stick, in real time and on a thread of its
/// own. It remembers all pictures that it encodes. Every function may be called from any thread.
class RobotServer {
 public:
  static constexpr auto kRobotPort = static_cast<std::uint16_t>(protocol::RCSERVER_PORT);

  using TimePoint = std::chrono::steady_clock::time_point;

  struct Encoded {
    std::uint64_t number;  ///< in the order of encoding; the first is 1
    TimePoint image_at;    ///< when the camera had the image
  };

  /// Returns when the server listens.
  /// @param address where clients connect
  /// @param port 0: any free one
  /// @param begin what its thread does first, if anything
  /// @throw openr_host::BootError, and whatever `begin` throws
  explicit RobotServer(const std::string& address = "127.0.0.1", std::uint16_t port = 0,
                       const std::function<void()>& begin = nullptr)
      : machine_(optionsFor(address, port), clock_, robot_) {
    std::promise<void> booted;
    std::future<void> result = booted.get_future();
    thread_ = std::thread([this, &begin, booted = std::move(booted)]() mutable { run(begin, &booted); });
    try {
      result.get();
    } catch (...) {
      thread_.join();
      throw;
    }
  }
  ~RobotServer() {
    machine_.stop();
    thread_.join();
  }

  RobotServer(const RobotServer&) = delete;
  RobotServer& operator=(const RobotServer&) = delete;

  int port() const { return machine_.hostPort(kRobotPort); }

  /// Looks up a picture. The result is empty if the server has not sent it.
  std::optional<Encoded> find(const std::vector<std::uint8_t>& jpeg) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = encoded_.find(hash(jpeg.data(), jpeg.size()));
    return found == encoded_.end() ? std::nullopt : std::optional<Encoded>(found->second);
  }

 private:
  static std::size_t hash(const unsigned char* bytes, std::size_t size) {
    return std::hash<std::string_view>()({reinterpret_cast<const char*>(bytes), size});
  }

  /// Calls a function before RCServer gets what comes to this gate.
  static void hear(const std::string& gate, openr_host::MachineOptions& options,
                   const std::function<void(const ONotifyEvent&)>& note) {
    for (auto& observer : options.catalog.at("RCSERVER.BIN").observers) {
      if (observer.service == gate) {
        observer.notify = [note, notify = observer.notify](OObject& object, const ONotifyEvent& event) {
          note(event);
          notify(object, event);
        };
      }
    }
  }

  openr_host::MachineOptions optionsFor(const std::string& address, std::uint16_t port) {
    openr_host::MachineOptions options;
    options.bind_address = address;
    options.ports = {{kRobotPort, port}};
    options.memory_stick = MEMORY_STICK;
    options.catalog = objectCatalog();
    hear("RCServer.Image.OFbkImageVectorData.O", options, [this](const ONotifyEvent&) {
      const std::lock_guard<std::mutex> lock(mutex_);
      image_at_ = std::chrono::steady_clock::now();
    });
    hear("RCServer.Picture.EncodedPicture.O", options,
         [this](const ONotifyEvent& event) { noteEncoded(*static_cast<const EncodedPicture*>(event.Data(0))); });
    return options;
  }

  void noteEncoded(const EncodedPicture& picture) {
    const std::lock_guard<std::mutex> lock(mutex_);
    encoded_[hash(picture.jpeg, picture.size)] = {encoded_.size() + 1, image_at_};
  }

  void run(const std::function<void()>& begin, std::promise<void>* booted) {
    try {
      if (begin) {
        begin();
      }
      machine_.boot();
    } catch (...) {
      booted->set_exception(std::current_exception());
      return;
    }
    booted->set_value();
    machine_.run();
    machine_.shutdown();
  }

  mutable std::mutex mutex_;                // guards what follows, down to the robot
  TimePoint image_at_;                      // the camera's last one
  std::map<std::size_t, Encoded> encoded_;  // by the hash of their bytes
  simulated_ers7::SimulatedErs7 robot_;
  openr_host::WallClock clock_;
  openr_host::Machine machine_;
  std::thread thread_;
};

}  // namespace fault_bench

#endif  // TEST_FAULT_ROBOT_SERVER_H
