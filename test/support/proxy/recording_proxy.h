/// @file recording_proxy.h
#ifndef TEST_SUPPORT_PROXY_RECORDING_PROXY_H
#define TEST_SUPPORT_PROXY_RECORDING_PROXY_H

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <iterator>
#include <mutex>
#include <string>
#include <vector>

#include "support/proxy/fault_proxy.h"
#include "support/proxy/scanners.h"

namespace test_support {

/// A proxy between a driver and a robot that passes every byte on, and remembers requests and pictures.
class RecordingProxy {
 public:
  /// @param robot_port where the robot listens, on 127.0.0.1
  explicit RecordingProxy(int robot_port) : proxy_(options(robot_port)) {}

  int port() const { return proxy_.port(); }

  /// Closes the present connection, if there is one.
  void cut() { proxy_.endConnections(Action::kClose); }

  /// While it is mute, nothing that the robot sends reaches the driver, though connections stay and are accepted.
  void setMute(bool mute) {
    Conditions conditions;
    conditions.paused = mute;
    proxy_.setConditions(conditions);
  }

  /// The JPEGs that the robot has sent since the proxy began, in this order.
  std::vector<Bytes> picturesFromRobot() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return pictures_;
  }

  /// What the driver has requested of a version 2 server, in this order.
  /// @param kinds only requests of these kinds
  std::vector<Request> requestsFromDriver(const std::string& kinds) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return requests(kinds);
  }

  /// Waits until the driver has made a request of one of these kinds.
  /// @return false if it did not come in time
  bool waitForRequest(const std::string& kinds, std::chrono::seconds timeout) {
    std::unique_lock<std::mutex> lock(mutex_);
    return changed_.wait_for(lock, timeout, [&] { return !requests(kinds).empty(); });
  }

 private:
  struct Connection {
    explicit Connection(std::vector<Bytes>* pictures)
        : replies([pictures](Bytes jpeg) { pictures->push_back(std::move(jpeg)); }) {}
    ReplyScanner replies;
    RequestScanner requests;
  };

  FaultProxy::Options options(int robot_port) {
    FaultProxy::Options options;
    options.target_port = robot_port;
    options.tap = [this](std::size_t connection, Direction direction, const std::uint8_t* data, std::size_t size) {
      record(connection, direction, data, size);
    };
    return options;
  }

  void record(std::size_t number, Direction direction, const std::uint8_t* data, std::size_t size) {
    const std::lock_guard<std::mutex> lock(mutex_);
    while (connections_.size() <= number) {
      connections_.emplace_back(&pictures_);
    }
    Connection& connection = connections_[number];
    if (direction == Direction::kToClient) {
      connection.replies.feed(data, size);
      return;
    }
    for (Request& request : connection.requests.feed(data, size)) {
      if (request.version2) {
        requests_.push_back(std::move(request));
      }
    }
    changed_.notify_all();
  }

  std::vector<Request> requests(const std::string& kinds) const {
    std::vector<Request> found;
    std::copy_if(requests_.begin(), requests_.end(), std::back_inserter(found),
                 [&kinds](const Request& request) { return kinds.find(request.kind) != std::string::npos; });
    return found;
  }

  mutable std::mutex mutex_;  // guards what follows, down to the proxy
  std::condition_variable changed_;
  std::vector<Bytes> pictures_;
  std::vector<Request> requests_;
  std::deque<Connection> connections_;
  FaultProxy proxy_;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_PROXY_RECORDING_PROXY_H
