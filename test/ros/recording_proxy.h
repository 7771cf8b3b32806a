/// @file recording_proxy.h
#ifndef TEST_ROS_RECORDING_PROXY_H
#define TEST_ROS_RECORDING_PROXY_H

#include <algorithm>
#include <iterator>
#include <mutex>
#include <string>
#include <vector>

#include "support/proxy/fault_proxy.h"
#include "support/proxy/scanner.h"
#include "support/safety_net.h"

namespace test_support {

/// What goes over the connections between a driver and a robot. Every function may be called from any thread.
class Recording {
 public:
  /// The JPEGs that the robot has sent since the proxy began, in this order.
  std::vector<Bytes> picturesFromRobot() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return pictures_;
  }

  /// What the driver has requested of a version 2 server, in this order.
  /// @param kinds only requests of these kinds
  std::vector<Message> requestsFromDriver(const std::string& kinds) const {
    std::vector<Message> found;
    const std::lock_guard<std::mutex> lock(mutex_);
    std::copy_if(requests_.begin(), requests_.end(), std::back_inserter(found), [&kinds](const Message& request) {
      return request.version2 && kinds.find(request.kind) != std::string::npos;
    });
    return found;
  }

  /// Waits until the driver has made a request of one of these kinds.
  bool waitForRequest(const std::string& kinds) const {
    return eventually([&] { return !requestsFromDriver(kinds).empty(); });
  }

 protected:
  void record(Direction direction, const Message& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (direction == Direction::kToServer) {
      requests_.push_back(message);
    } else if (message.kind == protocol::REPLY_PICTURE) {
      pictures_.push_back(message.payload);
    }
  }

 private:
  mutable std::mutex mutex_;  // guards what follows
  std::vector<Bytes> pictures_;
  std::vector<Message> requests_;
};

/// A proxy between a driver and a robot that passes every byte on, and remembers requests and pictures.
class RecordingProxy : public Recording, public FaultProxy {
 public:
  /// @param robot_port where the robot listens, on 127.0.0.1
  explicit RecordingProxy(int robot_port)
      : FaultProxy(robot_port, [this](Direction direction, const Message& message) { record(direction, message); }) {}

  /// While it is mute, nothing that the robot sends reaches the driver, though connections stay and are accepted.
  void setMute(bool mute) {
    Conditions conditions;
    conditions.paused = mute;
    setConditions(conditions);
  }
};

}  // namespace test_support

#endif  // TEST_ROS_RECORDING_PROXY_H
